#include "bristle/model/friction/formula.hpp"

#include "bristle/model/elementary.hpp"
#include "bristle/message.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

namespace bristle {
namespace {

using Function = std::function<double(double)>;

double hyperbolic_tangent(double x) {
  const double e = exp(-2 * std::abs(x));
  return std::copysign((1 - e) / (1 + e), x);
}

const std::map<std::string, double (*)(double)>& functions() {
  static const std::map<std::string, double (*)(double)> table = {
      {"abs", [](double x) { return std::abs(x); }},
      {"atan", atan},
      {"cos", cos},
      {"exp", exp},
      {"log", log},
      {"sin", sin},
      {"sqrt", [](double x) { return std::sqrt(x); }},
      {"tanh", hyperbolic_tangent}};
  return table;
}

// Parses by recursive descent: sum -> product -> signed -> power -> atom.
class Parser {
 public:
  Parser(const std::string& text, const std::string& variable) : text_(text), variable_(variable) {}

  Function parse() {
    Function all = sum();
    if (at_ < text_.size()) fail("one of + - * / ^ is expected");
    return all;
  }

 private:
  // Combines the members of a chain of operators from left to right.
  Function sum() {
    Function left = product();
    while (true)
      if (take('+')) left = [a = left, b = product()](double x) { return a(x) + b(x); };
      else if (take('-')) left = [a = left, b = product()](double x) { return a(x) - b(x); };
      else return left;
  }
  Function product() {
    Function left = with_sign();
    while (true)
      if (take('*')) left = [a = left, b = with_sign()](double x) { return a(x) * b(x); };
      else if (take('/')) left = [a = left, b = with_sign()](double x) { return a(x) / b(x); };
      else return left;
  }
  Function with_sign() {
    if (++depth_ > kDepth) fail("too many signs, powers and parentheses inside each other");
    Function out;
    if (take('-')) out = [a = with_sign()](double x) { return -a(x); };
    else out = power();
    --depth_;
    return out;
  }
  // Combines powers from right to left: a^b^c is a^(b^c), and -a^b is -(a^b).
  Function power() {
    Function base = atom();
    if (!take('^')) return base;
    return [a = base, b = with_sign()](double x) { return pow(a(x), b(x)); };
  }
  Function atom() {
    skip_spaces();
    if (take('(')) return in_parentheses();
    if (at_ < text_.size() && (std::isdigit(next()) || next() == '.')) return number();
    const std::size_t start = at_;
    while (at_ < text_.size() && (std::isalnum(next()) || next() == '_')) ++at_;
    const std::string name = text_.substr(start, at_ - start);
    if (name == variable_) return [](double x) { return x; };
    if (name == "pi") return [](double) { return M_PI; };
    const auto found = functions().find(name);
    if (found != functions().end() && take('('))
      return [f = found->second, inner = in_parentheses()](double x) { return f(inner(x)); };
    at_ = start;
    std::string names;
    for (const auto& [known, function] : functions()) names += (names.empty() ? "" : ", ") + known + "(...)";
    fail(message("a number, ", variable_, ", pi, a parenthesis or one of ", names, " is expected"));
  }
  Function in_parentheses() {
    Function inner = sum();
    if (!take(')')) fail("a closing parenthesis is expected");
    return inner;
  }
  Function number() {
    double value = 0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("is not a number");
    at_ += std::size_t(end - begin);
    return [value](double) { return value; };
  }

  unsigned char next() const { return static_cast<unsigned char>(text_[at_]); }
  void skip_spaces() {
    while (at_ < text_.size() && next() == ' ') ++at_;
  }
  bool take(char sign) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != sign) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void fail(const std::string& expected) const {
    const std::string found = at_ < text_.size() ? "at \"" + text_.substr(at_, 20) + "\"" : "at its end";
    throw std::invalid_argument(message("\"", text_, "\", ", found, ": ", expected));
  }

  static constexpr int kDepth = 100;
  const std::string &text_, &variable_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::function<double(double)> parse_formula(const std::string& text, const std::string& variable) {
  return Parser(text, variable).parse();
}

}  // namespace bristle
