# The shaders as C strings, comments stripped, so that the library needs no files at run time.
file(GLOB MNS_GLSL_FILES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/glsl/*.glsl)
set(MNS_GLSL_TEXT ${CMAKE_BINARY_DIR}/glsl_text.c)
add_executable(embed_glsl cmake/embed_glsl.c)
add_custom_command(
  OUTPUT ${MNS_GLSL_TEXT}
  COMMAND embed_glsl ${MNS_GLSL_TEXT} glsl_texts ${MNS_GLSL_FILES}
  DEPENDS embed_glsl ${MNS_GLSL_FILES}
  COMMENT "embedding glsl/")
