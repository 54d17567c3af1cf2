# How message types become C++: lcm-gen writes it, lcmtypes/harden.py makes its decode safe against the wire.

find_package(Python3 REQUIRED COMPONENTS Interpreter)
find_program(LCM_GEN lcm-gen REQUIRED)
find_path(LCM_INCLUDE_DIR lcm/lcm_coretypes.h REQUIRED)

# floornav_lcm_types(NAME PACKAGE FILES...): headers PACKAGE/xxx_t.hpp, through the INTERFACE library floornav_NAME, alias
# floornav::NAME.
function(floornav_lcm_types name package)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)
  set(hardened ${CMAKE_CURRENT_BINARY_DIR}/include)
  set(harden ${PROJECT_SOURCE_DIR}/lcmtypes/harden.py)
  set(headers)
  foreach(type ${ARGN})
    cmake_path(GET type STEM stem)
    cmake_path(ABSOLUTE_PATH type)
    set(header ${hardened}/${package}/${stem}.hpp)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${LCM_GEN} -x --cpp-std=c++11 --cpp-hpath ${generated} ${type}
      COMMAND ${Python3_EXECUTABLE} ${harden} ${type} ${generated}/${package}/${stem}.hpp ${header}
      DEPENDS ${type} ${harden} COMMENT "Hardening ${package}/${stem}.hpp" VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  add_custom_target(floornav_${name}_headers DEPENDS ${headers})

  add_library(floornav_${name} INTERFACE)
  add_library(floornav::${name} ALIAS floornav_${name})
  add_dependencies(floornav_${name} floornav_${name}_headers)
  target_include_directories(floornav_${name} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  target_include_directories(floornav_${name} SYSTEM INTERFACE $<BUILD_INTERFACE:${hardened}> ${LCM_INCLUDE_DIR})
endfunction()
