# Compiles the C++ of README.md: each block becomes a function of a translation unit, its #include lines go to the top.
file(READ ${PROJECT_SOURCE_DIR}/README.md text)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/README.md)
string(REPLACE ";" "\\;" text "${text}")
string(REPLACE "[" "<open>" text "${text}")
string(REPLACE "]" "<close>" text "${text}")
string(REGEX MATCHALL "```cpp\n[^`]*```" blocks "${text}")
set(number 0)
set(sources)
foreach(block IN LISTS blocks)
  math(EXPR number "${number} + 1")
  string(REPLACE "<open>" "[" block "${block}")
  string(REPLACE "<close>" "]" block "${block}")
  string(REGEX REPLACE "^```cpp\n|```$" "" block "${block}")
  string(REGEX MATCHALL "#include [^\n]*\n" includes "${block}")
  string(REGEX REPLACE "#include [^\n]*\n|using namespace winnow;\n" "" body "${block}")
  string(REPLACE ";" "" includes "${includes}")
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/readme/${number}.cpp @ONLY CONTENT
"@includes@#include \"support/readme.hpp\"
namespace readme_@number@ {
@body@
}
")
  list(APPEND sources ${CMAKE_CURRENT_BINARY_DIR}/readme/${number}.cpp)
endforeach()
if(number EQUAL 0)
  message(FATAL_ERROR "README.md has no C++")
endif()
add_library(test-readme OBJECT ${sources})
target_link_libraries(test-readme PRIVATE winnow-simulator)
target_include_directories(test-readme PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
