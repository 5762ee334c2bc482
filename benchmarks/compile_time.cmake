# How long a compiler takes to read winnow: cmake -D CXX=g++ -D SOURCE_DIR=... -P compile_time.cmake
set(folder "$ENV{TMPDIR}")
if(NOT folder)
  set(folder /tmp)
endif()
set(folder ${folder}/winnow-compile-time)
file(MAKE_DIRECTORY ${folder})

function(measure name flags text)
  file(WRITE ${folder}/unit.cpp "${text}\n")
  set(best 1000000)
  foreach(try RANGE 2)
    string(TIMESTAMP before "%s%f" UTC)
    execute_process(COMMAND ${CXX} -std=c++20 -march=native -fopenmp ${flags} -I${SOURCE_DIR}/include
        ${folder}/unit.cpp -o ${folder}/unit.o
      RESULT_VARIABLE failed ERROR_VARIABLE message)
    string(TIMESTAMP after "%s%f" UTC)
    if(failed)
      message(FATAL_ERROR "${message}")
    endif()
    math(EXPR milliseconds "(${after} - ${before}) / 1000")
    if(milliseconds LESS best)
      set(best ${milliseconds})
    endif()
  endforeach()
  message(STATUS "${best} ms  ${name}")
endfunction()

set(candidate "#include <winnow/image/image.hpp>\n#include <winnow/paper/rdfc_2013.hpp>
using namespace winnow;
template <class Executor> void denoise(const Executor& executor) {
    image<float> rgb({64, 64}, 3), z({64, 64}), out({64, 64}, 3);
    frame in{color = rgb.view(), variance(color) = rgb.view(), albedo = rgb.view(), variance(albedo) = rgb.view(),
             normal = rgb.view(), variance(normal) = rgb.view(), depth = z.view(), variance(depth) = z.view()};
    paper::make_rdfc_candidate()(in, output(out), executor);
}")
measure("umbrella winnow/winnow.hpp, syntax only" "-fsyntax-only" "#include <winnow/winnow.hpp>")
measure("executor/simd.hpp (xsimd), syntax only" "-fsyntax-only" "#include <winnow/executor/simd.hpp>")
measure("rdfc candidate on serial, -O2" "-O2;-c"
  "${candidate}\n#include <winnow/executor/serial.hpp>\ntemplate void denoise(const executor::serial<>&);")
measure("rdfc candidate on simd, -O2" "-O2;-c"
  "${candidate}\n#include <winnow/executor/simd.hpp>\ntemplate void denoise(const executor::simd&);")
measure("rdfc candidate on openmp, -O2" "-O2;-c"
  "${candidate}\n#include <winnow/executor/openmp.hpp>\ntemplate void denoise(const executor::openmp&);")
