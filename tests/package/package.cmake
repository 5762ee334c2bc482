# SPDX-License-Identifier: Apache-2.0 WITH LLVM-exception
# Builds and runs the project in user/, which gets winnow by find_package or by add_subdirectory:
#     cmake -D WAY=... -D REPOSITORY=... -D BUILD=... -D SCRATCH=... -D COMPILER=... -D GENERATOR=... -P package.cmake
cmake_minimum_required(VERSION 3.24)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(failed)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

set(scratch ${SCRATCH}-${WAY})
file(REMOVE_RECURSE ${scratch})
if(WAY STREQUAL "find_package")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${scratch}/prefix)
  # The installed headers are those of the repository, no more and no fewer.
  file(GLOB_RECURSE installed RELATIVE ${scratch}/prefix/include ${scratch}/prefix/include/*)
  file(GLOB_RECURSE ours RELATIVE ${REPOSITORY}/include ${REPOSITORY}/include/*)
  if(NOT installed STREQUAL ours)
    message(FATAL_ERROR "installed: ${installed}\nbut there are: ${ours}")
  endif()
endif()

run(${CMAKE_COMMAND} -S ${REPOSITORY}/tests/package/user -B ${scratch}/build -G ${GENERATOR} -D WAY=${WAY}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${scratch}/prefix -D WINNOW_REPOSITORY=${REPOSITORY}
  -D CMAKE_EXPORT_COMPILE_COMMANDS=ON)
run(${CMAKE_COMMAND} --build ${scratch}/build)
run(${scratch}/build/user)
if(NOT out MATCHES "filtered")
  message(FATAL_ERROR "the user's program says: ${out}")
endif()

# Of our flags only the language's version reaches the user.
file(READ ${scratch}/build/compile_commands.json commands)
if(commands MATCHES "-W[a-z]|-march|-fopenmp|-fsanitize|xsimd|Catch")
  message(FATAL_ERROR "a flag of ours reaches the user: ${CMAKE_MATCH_0} in\n${commands}")
endif()
file(REMOVE_RECURSE ${scratch})
