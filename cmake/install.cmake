# `cmake --install`: library, header, program, pkg-config file, CMake package; all of it may be moved afterwards.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS meniscus EXPORT meniscus
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  PUBLIC_HEADER DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

if(TARGET meniscus_program)
  file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(meniscus_program PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
  install(TARGETS meniscus_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

file(RELATIVE_PATH MNS_PKGCONFIG_TO_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" MNS_PKGCONFIG_TO_PREFIX ${MNS_PKGCONFIG_TO_PREFIX})
configure_file(cmake/meniscus.pc.in meniscus.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/meniscus.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/meniscus)
configure_package_config_file(cmake/meniscus-config.cmake.in meniscus-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(meniscus-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/meniscus-config.cmake ${CMAKE_BINARY_DIR}/meniscus-config-version.cmake
  DESTINATION ${package_folder})
install(EXPORT meniscus NAMESPACE meniscus:: FILE meniscus-targets.cmake DESTINATION ${package_folder})

# A host program is built and run against an installed copy, by pkg-config and by find_package.
if(MNS_TESTS)
  add_test(NAME install COMMAND ${CMAKE_SOURCE_DIR}/tests/install/check.sh)
  set(environment CMAKE=${CMAKE_COMMAND} BUILD=${CMAKE_BINARY_DIR} LIBDIR=${CMAKE_INSTALL_LIBDIR}
    BINDIR=${CMAKE_INSTALL_BINDIR} CC=${CMAKE_C_COMPILER} GENERATOR=${CMAKE_GENERATOR})
  if(MNS_SANITIZE)
    list(APPEND environment "HOST_FLAGS=-fsanitize=${MNS_SANITIZE}")
  endif()
  set_tests_properties(install PROPERTIES ENVIRONMENT "${environment}")
endif()
