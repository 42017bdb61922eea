# The GL loader, generated at build time by glad 2 (offline: --reproducible), with one table a context (mx).
find_program(GLAD_PROGRAM glad REQUIRED)
set(GLAD_DIR ${CMAKE_BINARY_DIR}/glad)
set(GLAD_SOURCE ${GLAD_DIR}/src/gl.c)
add_custom_command(
  OUTPUT ${GLAD_SOURCE} ${GLAD_DIR}/include/glad/gl.h
  COMMAND ${GLAD_PROGRAM} --quiet --reproducible --api gl:core=4.3 --out-path ${GLAD_DIR}
          --extensions GL_ARB_clip_control,GL_KHR_debug,GL_ARB_buffer_storage c --mx
  COMMENT "glad: OpenGL 4.3 core loader")
add_library(glad OBJECT ${GLAD_SOURCE})
set_target_properties(glad PROPERTIES POSITION_INDEPENDENT_CODE ON C_VISIBILITY_PRESET hidden)
target_include_directories(glad SYSTEM PUBLIC ${GLAD_DIR}/include)
