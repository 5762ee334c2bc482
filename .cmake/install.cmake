# Installs the headers and a package that find_package(winnow) finds.
include(CMakePackageConfigHelpers)

function(winnow_install target)
  set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/winnow)
  install(TARGETS ${target} EXPORT winnow-targets FILE_SET HEADERS)
  install(EXPORT winnow-targets NAMESPACE winnow:: DESTINATION ${destination})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/winnow-config-version.cmake
    COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
  configure_package_config_file(.cmake/winnow-config.cmake.in ${PROJECT_BINARY_DIR}/winnow-config.cmake
    INSTALL_DESTINATION ${destination})
  install(FILES ${PROJECT_BINARY_DIR}/winnow-config.cmake ${PROJECT_BINARY_DIR}/winnow-config-version.cmake
    DESTINATION ${destination})
endfunction()
