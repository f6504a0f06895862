# cmake --install: the library, its headers, and what find_package(layout_embedding) reads.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Headers lie in a folder of the library's own, and name each other from there.
target_include_directories(layout_embedding PUBLIC
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/layout_embedding>)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/layout_embedding)
install(TARGETS layout_embedding EXPORT layout_embedding_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/layout_embedding
        FILES_MATCHING PATTERN "*.hh" PATTERN shapes EXCLUDE)
install(EXPORT layout_embedding_targets NAMESPACE layout_embedding:: DESTINATION ${package_folder})

set(config ${CMAKE_CURRENT_BINARY_DIR}/layout_embedding-config.cmake)
file(CONFIGURE OUTPUT ${config} @ONLY CONTENT [[
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
include(${CMAKE_CURRENT_LIST_DIR}/layout_embedding_targets.cmake)
]])
# Before 1.0 any minor version may change the interface.
set(version ${CMAKE_CURRENT_BINARY_DIR}/layout_embedding-config-version.cmake)
write_basic_package_version_file(${version} COMPATIBILITY SameMinorVersion)
install(FILES ${config} ${version} DESTINATION ${package_folder})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
