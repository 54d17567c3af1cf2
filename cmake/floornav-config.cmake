# find_package(floornav): floornav::planner (needs Eigen alone) and floornav::lcmtypes (needs LCM's headers).
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
include(${CMAKE_CURRENT_LIST_DIR}/floornav-targets.cmake)
