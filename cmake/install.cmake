# cmake --install: the parts that other programs link, with find_package(floornav). The headers keep their places under
# one folder, so that they include each other as they do here.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(installed_headers ${CMAKE_INSTALL_INCLUDEDIR}/floornav)
set(installed_package ${CMAKE_INSTALL_LIBDIR}/cmake/floornav)

foreach(part planner geometry lcmtypes)
  set_target_properties(floornav_${part} PROPERTIES EXPORT_NAME ${part})
  target_include_directories(floornav_${part} INTERFACE $<INSTALL_INTERFACE:${installed_headers}>)
endforeach()
install(TARGETS floornav_planner floornav_geometry floornav_lcmtypes EXPORT floornav_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT floornav_targets NAMESPACE floornav:: FILE floornav-targets.cmake DESTINATION ${installed_package})

install(DIRECTORY planner DESTINATION ${installed_headers} FILES_MATCHING PATTERN "*.hpp"
        PATTERN node EXCLUDE PATTERN example EXCLUDE)
install(DIRECTORY runtime/geometry DESTINATION ${installed_headers}/runtime FILES_MATCHING PATTERN "*.hpp")
install(FILES mapping/clearances.hpp mapping/grid_map.hpp mapping/seen_times.hpp mapping/sigma_code.hpp mapping/tile_map.hpp mapping/vertex_states.hpp
        DESTINATION ${installed_headers}/mapping)
install(FILES lcmtypes/channels.hpp lcmtypes/wire_checks.hpp DESTINATION ${installed_headers}/lcmtypes)
install(DIRECTORY ${PROJECT_BINARY_DIR}/lcmtypes/include/floornav DESTINATION ${installed_headers})

write_basic_package_version_file(${PROJECT_BINARY_DIR}/floornav-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/floornav-config.cmake ${PROJECT_BINARY_DIR}/floornav-config-version.cmake DESTINATION ${installed_package})
