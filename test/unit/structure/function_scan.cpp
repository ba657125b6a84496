// What counts the lines and parameters of functions counts right.
#include "unit/structure/function_scan.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sunlit {
namespace {

std::vector<FunctionShape> functionsOf(const std::string& text) {
  return FunctionScan(text).functions();
}

/// Names, each with its parameters and lines.
std::string shapesOf(const std::string& text) {
  std::string shapes;
  for (const FunctionShape& shape : functionsOf(text))
    shapes += shape.name + " " + std::to_string(shape.parameters) + " " + std::to_string(shape.lines) + "\n";
  return shapes;
}

TEST(FunctionScan, FindsALongFunction) {
  std::string text = "int f() {\n";
  for (int i = 0; i < 60; ++i) text += "  work();\n";
  const auto found = functionsOf("\n" + text + "}\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].lines, 62u);
  EXPECT_EQ(found[0].first_line, 2u);
}

TEST(FunctionScan, CountsParameters) {
  EXPECT_EQ(shapesOf("void f() {}"), "f 0 1\n");
  EXPECT_EQ(shapesOf("void f(void) {}"), "f 0 1\n");
  EXPECT_EQ(shapesOf("int f(int a,\n      int b, int c,\n      int d, int e) { return a; }"), "f 5 3\n");
  // Commas within one parameter are none between two.
  EXPECT_EQ(shapesOf("void f(std::map<int, std::pair<int, int>> a, std::function<void(int, int)> b) {}"),
            "f 2 1\n");
  EXPECT_EQ(shapesOf("void f(P a = {1, 2}, int (&b)[3], int c = g(1, 2)) {}"), "f 3 1\n");
}

TEST(FunctionScan, KnowsTextFromCode) {
  EXPECT_EQ(
      shapesOf(
          "void f(int a, /* int b, */ char c = ',') {  // { (\n  g(\"}{\\\"(\", '{', R\"x(}\")x\"); }\n"),
      "f 2 2\n");
  EXPECT_EQ(shapesOf("#define F(a, b) \\\n  void g() {\nvoid f(int a = 1'000) {}\n"), "f 1 1\n");
}

TEST(FunctionScan, KnowsMembersFromBodies) {
  EXPECT_EQ(shapesOf("A::A(int a, int b) : a_{a}, b_(b), c_{a, b} {\n}\nvoid A::f() {}\n"),
            "A::A 2 2\nA::f 0 1\n");
  EXPECT_EQ(
      shapesOf("class A : public B {\n public:\n  explicit A(int a) : B(a) {}\n  ~A() {}\n  int b{3};\n};"),
      "A 1 1\n~A 0 1\n");
  EXPECT_EQ(shapesOf("constexpr int k[] = {1, 2};\nconst auto f = [](int a, int b) { return a; };\nint "
                     "c{4};\nenum class E { kA };"),
            "");
}

TEST(FunctionScan, CountsLambdasAndLocalClassesToWhereTheyStand) {
  EXPECT_EQ(shapesOf("void f() {\n  struct A { void g(int a, int b) {} };\n  call([&](int a) {\n  });\n}"),
            "f 0 5\n");
}

TEST(FunctionScan, LooksThroughTemplatesAndAttributes) {
  EXPECT_EQ(shapesOf("template <typename A, int kB = 3>\n[[nodiscard]] A f(A a) noexcept(true) {\n}"),
            "f 1 2\n");
  EXPECT_EQ(shapesOf("inline __attribute__((always_inline)) void f(int a) {}"), "f 1 1\n");
  EXPECT_EQ(shapesOf("template <typename T>\nclass A {\n  T get() const { return {}; }\n};"), "get 0 1\n");
  EXPECT_EQ(shapesOf("auto f(int a) -> std::vector<int> {\n}"), "f 1 2\n");
}

TEST(FunctionScan, KeepsWhatStandsBeforeTheName) {
  const auto found = functionsOf("int a;\nMARK\nvoid A::f() {}");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].before.find("MARK\nvoid"), std::string::npos);
}

TEST(FunctionScan, KnowsOperators) {
  EXPECT_EQ(shapesOf("bool operator()(int a, int b) const {}"), "operator() 2 1\n");
  EXPECT_EQ(shapesOf("A& operator=(const A& a) {}"), "operator= 1 1\n");
  EXPECT_EQ(shapesOf("bool operator<(const A& a, const A& b) {}"), "operator< 2 1\n");
}

}  // namespace
}  // namespace sunlit
