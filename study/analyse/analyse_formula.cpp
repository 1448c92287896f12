#include "study/analyse/analyse_formula.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

/// A number, a name, or an operation on one or two nodes.
struct Formula::Node {
    char operation = 'n';  ///< n number, v name, + - * / m(od) ^, and ~ (minus) s(qrt) f(loor) a(bs) l (fl)
    FormulaNumber number;
    std::size_t name = 0;
    std::unique_ptr<Node> left;
    std::unique_ptr<Node> right;
};

namespace {

using Node = Formula::Node;
using NodePointer = std::unique_ptr<Node>;

constexpr WideInteger largestWhole = WideInteger(1) << 120;

bool fits(WideInteger x) { return x < largestWhole && x > -largestWhole; }

/// The remainder between 0 and the modulus, also for a negative x.
WideInteger remainder(WideInteger x, WideInteger modulus)
{
    if (modulus > 0 && (modulus & (modulus - 1)) == 0) return x & (modulus - 1);
    const WideInteger rest = x % modulus;
    return rest < 0 ? rest + modulus : rest;
}

FormulaNumber power(const FormulaNumber& base, const FormulaNumber& exponent)
{
    if (base.isWhole && exponent.isWhole && exponent.whole >= 0 && exponent.whole <= 120) {
        constexpr WideInteger largestBase = WideInteger(1) << 60;
        WideInteger result = 1;
        bool exact = exponent.whole == 0 || (base.whole < largestBase && base.whole > -largestBase);
        for (WideInteger i = 0; i < exponent.whole && exact; ++i)
            exact = !__builtin_mul_overflow(result, base.whole, &result) && fits(result) && fits(result * 2);
        if (exact) return FormulaNumber::ofWhole(result);
    }
    return FormulaNumber::ofReal(std::pow(base.real, exponent.real));
}

FormulaNumber ofWholes(char operation, WideInteger a, WideInteger b)
{
    constexpr WideInteger factor = WideInteger(1) << 63;
    const bool canMultiply = a < factor && a > -factor && b < factor && b > -factor;
    if (operation == '+') return FormulaNumber::ofWhole(a + b);
    if (operation == '-') return FormulaNumber::ofWhole(a - b);
    if (operation == '*' && canMultiply) return FormulaNumber::ofWhole(a * b);
    if (operation == 'm' && b != 0) return FormulaNumber::ofWhole(remainder(a, b));
    const auto x = static_cast<double>(a);
    const auto y = static_cast<double>(b);
    return FormulaNumber::ofReal(operation == '*' ? x * y : operation == '/' ? x / y : std::fmod(x, y));
}

FormulaNumber ofReals(char operation, double a, double b)
{
    switch (operation) {
        case '+':
            return FormulaNumber::ofReal(a + b);
        case '-':
            return FormulaNumber::ofReal(a - b);
        case '*':
            return FormulaNumber::ofReal(a * b);
        case '/':
            return FormulaNumber::ofReal(a / b);
        default:
            return FormulaNumber::ofReal(a - b * std::floor(a / b));
    }
}

FormulaNumber ofOne(char operation, const FormulaNumber& x)
{
    if (operation == '~') return x.isWhole ? FormulaNumber::ofWhole(-x.whole) : FormulaNumber::ofReal(-x.real);
    if (operation == 's') return FormulaNumber::ofReal(std::sqrt(x.real));
    if (operation == 'f') return x.isWhole ? x : FormulaNumber::ofReal(std::floor(x.real));
    if (operation == 'a')
        return x.isWhole && x.whole < 0 ? FormulaNumber::ofWhole(-x.whole) : FormulaNumber::ofReal(std::fabs(x.real));
    return FormulaNumber::ofReal(x.real);
}

FormulaNumber valueOf(const Node& node, const std::vector<FormulaNumber>& values)
{
    if (node.operation == 'n') return node.number;
    if (node.operation == 'v') return values[node.name];
    const FormulaNumber left = valueOf(*node.left, values);
    if (!node.right) return ofOne(node.operation, left);
    const FormulaNumber right = valueOf(*node.right, values);
    if (node.operation == '^') return power(left, right);
    if (left.isWhole && right.isWhole && fits(left.whole) && fits(right.whole))
        return ofWholes(node.operation, left.whole, right.whole);
    return ofReals(node.operation, left.real, right.real);
}

/// Replaces an operation on constants by its value.
NodePointer folded(NodePointer node)
{
    const bool isConstant = node->left && node->left->operation == 'n' && (!node->right || node->right->operation == 'n');
    if (!isConstant) return node;
    auto number = std::make_unique<Node>();
    number->number = valueOf(*node, {});
    return number;
}

NodePointer operation(char sign, NodePointer left, NodePointer right)
{
    auto node = std::make_unique<Node>();
    node->operation = sign;
    node->left = std::move(left);
    node->right = std::move(right);
    return folded(std::move(node));
}

class FormulaReader {
public:
    FormulaReader(std::string_view text, const std::vector<std::string>& names) : m_text(text), m_names(names) {}

    NodePointer sum()
    {
        if (++m_depth > 100) throw fault("at most 100 nested parentheses");
        NodePointer left = product();
        for (;;) {
            if (take("+"))
                left = operation('+', std::move(left), product());
            else if (take("-"))
                left = operation('-', std::move(left), product());
            else
                break;
        }
        --m_depth;
        return left;
    }

    std::string rest() const { return std::string(m_text.substr(m_at)); }

private:
    NodePointer product()
    {
        NodePointer left = raised();
        for (;;) {
            if (take("*"))
                left = operation('*', std::move(left), raised());
            else if (take("/"))
                left = operation('/', std::move(left), raised());
            else if (take("mod") || take("%"))
                left = operation('m', std::move(left), raised());
            else
                return left;
        }
    }

    NodePointer raised()
    {
        if (take("-")) return operation('~', raised(), nullptr);
        NodePointer base = primary();
        return take("^") || take("**") ? operation('^', std::move(base), raised()) : std::move(base);
    }

    NodePointer primary()
    {
        skipSpace();
        if (take("(")) return closed(sum());
        if (m_at < m_text.size() && (std::isdigit(byte()) != 0 || byte() == '.')) return number();
        return named();
    }

    NodePointer closed(NodePointer inner)
    {
        if (!take(")")) throw fault("a closing parenthesis");
        return inner;
    }

    NodePointer number()
    {
        const char* begin = m_text.data() + m_at;
        const char* end = m_text.data() + m_text.size();
        const char* digits = std::find_if_not(begin, end, [](unsigned char c) { return std::isdigit(c) != 0; });
        auto node = std::make_unique<Node>();
        long long whole = 0;
        const auto asWhole = std::from_chars(begin, digits, whole);
        const bool goesOn = digits != end && (*digits == '.' || *digits == 'e' || *digits == 'E') &&
                            !(digits + 1 != end && *digits == '.' && digits[1] == '.');
        if (!goesOn && asWhole.ec == std::errc{}) {
            node->number = FormulaNumber::ofWhole(whole);
            m_at += static_cast<std::size_t>(digits - begin);
        } else {
            double real = 0;
            const auto asReal = std::from_chars(begin, end, real);
            if (asReal.ec != std::errc{}) throw fault("a number within the range of double");
            node->number = FormulaNumber::ofReal(real);
            m_at += static_cast<std::size_t>(asReal.ptr - begin);
        }
        // ".8a" means ".8*a".
        const bool isFactor = m_at < m_text.size() && std::isalpha(byte()) != 0 && !m_text.substr(m_at).starts_with("mod");
        return isFactor ? operation('*', std::move(node), named()) : std::move(node);
    }

    NodePointer named()
    {
        const std::string name = word();
        if (const char function = functionNamed(name); function != 0) {
            if (!take("(")) throw fault("( after " + name);
            return operation(function, closed(sum()), nullptr);
        }
        auto node = std::make_unique<Node>();
        const auto found = std::find(m_names.begin(), m_names.end(), name);
        if (found == m_names.end()) throw fault(name.empty() ? "a number or a name" : "a known name instead of " + name);
        node->operation = 'v';
        node->name = static_cast<std::size_t>(found - m_names.begin());
        return node;
    }

    static char functionNamed(const std::string& name)
    {
        return name == "sqrt" ? 's' : name == "floor" ? 'f' : name == "abs" ? 'a' : name == "fl" ? 'l' : '\0';
    }

    /// A name without its index: "x" for "x_i".
    std::string word()
    {
        skipSpace();
        std::string name;
        while (m_at < m_text.size() && (std::isalnum(byte()) != 0)) name += m_text[m_at++];
        if (m_at + 1 < m_text.size() && byte() == '_' && std::isalpha(static_cast<unsigned char>(m_text[m_at + 1])) != 0) {
            ++m_at;
            while (m_at < m_text.size() && std::isalnum(byte()) != 0) ++m_at;
        }
        return name;
    }

    bool take(std::string_view sign)
    {
        skipSpace();
        if (!m_text.substr(m_at).starts_with(sign)) return false;
        if (sign == "*" && m_text.substr(m_at).starts_with("**")) return false;
        m_at += sign.size();
        return true;
    }

    void skipSpace()
    {
        while (m_at < m_text.size() && std::isspace(byte()) != 0) ++m_at;
    }

    unsigned char byte() const { return static_cast<unsigned char>(m_text[m_at]); }

    RequestFault fault(const std::string& expected) const
    {
        return RequestFault("the formula \"" + std::string(m_text) + "\" has a fault at character " + std::to_string(m_at + 1) +
                            ": expected " + expected);
    }

    std::string_view m_text;
    const std::vector<std::string>& m_names;
    std::size_t m_at = 0;
    int m_depth = 0;
};

}  // namespace

Formula::Formula(std::string_view text, const std::vector<std::string>& names, std::string* rest)
{
    constexpr std::size_t longestFormula = 10'000;  // reading and evaluating are recursive
    if (text.size() > longestFormula)
        throw RequestFault("the formula has " + std::to_string(text.size()) + " characters; expected at most " +
                           std::to_string(longestFormula));
    FormulaReader reader(text, names);
    m_root = reader.sum();
    const std::string remainder = reader.rest();
    if (rest != nullptr)
        *rest = remainder;
    else if (remainder.find_first_not_of(" \t") != std::string::npos)
        throw RequestFault("the formula \"" + std::string(text) + "\" ends at \"" + remainder + "\"");
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

FormulaNumber Formula::evaluate(const std::vector<FormulaNumber>& values) const { return valueOf(*m_root, values); }

}  // namespace study::analyse
