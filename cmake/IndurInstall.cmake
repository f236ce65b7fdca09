# What `cmake --install` writes, and the package files that find_package(InduRoP) reads from an installation or
# directly from this build directory.
include(CMakePackageConfigHelpers)

set(indurop_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/InduRoP)
set(indurop_share_dir ${CMAKE_INSTALL_DATADIR}/indurop)

install(TARGETS indurop_headers indurop indurop_c_shared indurop_testing glb2idl indurop_cli EXPORT InduRoPTargets
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# A set of its own: the Debian package indurop-dev is complete without the library for robots.
install(TARGETS robot EXPORT InduRoPRobotTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/indurop DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
foreach(set InduRoPTargets InduRoPRobotTargets)
  install(EXPORT ${set} NAMESPACE indurop:: DESTINATION ${indurop_package_dir})
  export(EXPORT ${set} NAMESPACE indurop:: FILE ${PROJECT_BINARY_DIR}/${set}.cmake)
endforeach()

# One configuration file for each of the two trees.
set(indurop_modules ${indurop_package_dir}/IndurModules.cmake)
set(indurop_programs ${CMAKE_INSTALL_BINDIR})
set(indurop_xsd ${indurop_share_dir}/module.xsd)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/InduRoPConfig.cmake.in
  ${PROJECT_BINARY_DIR}/install-files/InduRoPConfig.cmake
  INSTALL_DESTINATION ${indurop_package_dir} PATH_VARS indurop_modules indurop_programs indurop_xsd)
set(indurop_modules ${PROJECT_SOURCE_DIR}/cmake/IndurModules.cmake)
set(indurop_programs ${PROJECT_BINARY_DIR}/bin)
set(indurop_xsd ${PROJECT_SOURCE_DIR}/config/xml/module.xsd)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/InduRoPConfig.cmake.in
  ${PROJECT_BINARY_DIR}/InduRoPConfig.cmake
  INSTALL_DESTINATION ${PROJECT_BINARY_DIR} INSTALL_PREFIX ${PROJECT_BINARY_DIR}
  PATH_VARS indurop_modules indurop_programs indurop_xsd)
# Below 1.0 a new minor version may change the API.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/InduRoPConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/install-files/InduRoPConfig.cmake
  ${PROJECT_BINARY_DIR}/InduRoPConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/IndurModules.cmake
  ${PROJECT_SOURCE_DIR}/idl/IndurIdlc.cmake
  DESTINATION ${indurop_package_dir})

install(FILES ${PROJECT_SOURCE_DIR}/control/plc/motion/motion.st DESTINATION ${indurop_share_dir}/plc)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${indurop_share_dir} USE_SOURCE_PERMISSIONS)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md" PATTERN "*.png" PATTERN "*.svg")
