# Writes OUTPUT: a C++ file with a function NAMESPACE::NAME that returns the text of INPUT.
file(READ ${INPUT} text)
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
namespace @NAMESPACE@ {
const char* @NAME@() { return R"__embedded__(@text@)__embedded__"; }
}
]])
