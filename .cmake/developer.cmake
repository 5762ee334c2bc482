# What our own targets need and users never inherit: warnings, sanitizers, the libraries of tests and programs.
find_package(xsimd QUIET)
find_package(OpenMP COMPONENTS CXX QUIET)

add_library(winnow-developer INTERFACE)
target_compile_options(winnow-developer INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 takes the undefined lanes inside its own AVX-512 intrinsics for a mistake of ours.
  target_compile_options(winnow-developer INTERFACE -Wshadow=local -Wno-maybe-uninitialized -Wno-uninitialized -fconcepts-diagnostics-depth=2)
else()
  target_compile_options(winnow-developer INTERFACE -Wshadow)
endif()
if(WINNOW_NATIVE)
  target_compile_options(winnow-developer INTERFACE -march=native)
endif()
if(WINNOW_SANITIZE)
  target_compile_options(winnow-developer INTERFACE -fsanitize=${WINNOW_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(winnow-developer INTERFACE -fsanitize=${WINNOW_SANITIZE})
  # Whether a temporary is used after its scope is asked at every one of them: a sweep, all of it inlined, takes twenty
  # times as long to compile.
  if(WINNOW_SANITIZE MATCHES "address")
    target_compile_options(winnow-developer INTERFACE -fno-sanitize-address-use-after-scope)
  endif()
endif()
# winnow's own headers are not system headers here: their warnings count.
target_link_libraries(winnow-developer INTERFACE winnow)
if(TARGET xsimd)
  target_include_directories(winnow-developer SYSTEM INTERFACE $<TARGET_PROPERTY:xsimd,INTERFACE_INCLUDE_DIRECTORIES>)
endif()
if(OpenMP_CXX_FOUND)
  target_link_libraries(winnow-developer INTERFACE OpenMP::OpenMP_CXX)
endif()

# What the simulator needs: Eigen, and products and sums that are rounded one by one.  Contracted to fused ones, as the
# compiler pleases, a path could depend in its last bit on code around it that it does not run.
find_package(Eigen3 QUIET NO_MODULE)
add_library(winnow-simulator INTERFACE)
target_link_libraries(winnow-simulator INTERFACE winnow-developer)
target_compile_options(winnow-simulator INTERFACE -ffp-contract=off)
if(TARGET Eigen3::Eigen)
  target_include_directories(winnow-simulator SYSTEM INTERFACE $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)
endif()

# The version, for programs that write it into their files.
target_compile_definitions(winnow-developer INTERFACE WINNOW_VERSION="${PROJECT_VERSION}")
