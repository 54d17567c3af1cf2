# Installs the library, builds the consumer against what was installed, and runs it.
# cmake -D BUILD=... -D WORK=... -D SOURCE=... -P consumer_test.cmake
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/planner/consumer -B ${WORK}/build -G Ninja -D CMAKE_PREFIX_PATH=${WORK}/installed
    -D EXAMPLE_FOLDER=${SOURCE}/planner/example)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/plan)
run(${WORK}/build/follow)
