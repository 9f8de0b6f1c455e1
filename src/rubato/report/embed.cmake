# SPDX-License-Identifier: LGPL-3.0-or-later
# cmake -DOUTPUT=assets.cpp -DFOLDER=web -DFILES="a;b" -P embed.cmake: writes the files as strings of a C++ source. A
# string of half a megabyte costs a compiler less than an array of as many numbers, and its size is known without counting.
set(source "#include \"rubato/report/assets.hpp\"\n\nnamespace rubato::report {\nnamespace {\n\n")
set(rows)
set(number 0)
foreach(file IN LISTS FILES)
  file(READ ${FOLDER}/${file} text)
  string(APPEND source "constexpr char text${number}[] = R\"rubato_asset(${text})rubato_asset\";\n")
  string(APPEND rows "  if (name == \"${file}\")\n    return {text${number}, sizeof text${number} - 1};\n")
  math(EXPR number "${number} + 1")
endforeach()
string(APPEND source "\n} // namespace\n\nstd::string_view asset(std::string_view name) {\n${rows}"
                     "  throw std::out_of_range(\"no such part of the page\");\n}\n\n} // namespace rubato::report\n")
file(WRITE ${OUTPUT} "${source}")
