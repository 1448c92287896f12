// Arithmetic formulas over named numbers: + - * / mod ^, parentheses, sqrt, floor, abs, and fl, which rounds to double and
// so changes nothing here.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace study::analyse {

__extension__ typedef __int128 WideInteger;

/// A number of a formula. It is whole as long as whole numbers are only added, subtracted, multiplied, reduced by a modulus
/// or raised to whole powers.
struct FormulaNumber {
    bool isWhole = false;
    WideInteger whole = 0;
    double real = 0;

    static FormulaNumber ofWhole(WideInteger number) { return {true, number, static_cast<double>(number)}; }
    static FormulaNumber ofReal(double number) { return {false, 0, number}; }
};

class Formula {
public:
    /// Reads the formula at the start of `text`; `rest` gets the text after it, for instance a remark. `names` are the
    /// numbers that it may use, in the order of the values that evaluate() receives. Throws RequestFault.
    Formula(std::string_view text, const std::vector<std::string>& names, std::string* rest = nullptr);
    ~Formula();
    Formula(Formula&&) noexcept;

    FormulaNumber evaluate(const std::vector<FormulaNumber>& values) const;

    struct Node;

private:
    std::unique_ptr<Node> m_root;
};

}  // namespace study::analyse
