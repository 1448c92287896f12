#include "reports/json/json_members.h"

#include <nlohmann/json.hpp>

#include "protocols/answer_kind.h"

namespace reports {
namespace {

constexpr std::size_t indent = 2;

/// Texts of larger values are written element by element down to this depth.
constexpr int deepest = 3;

/// The text of a value whose lines, all but the first, are moved to the right.
std::string indented(const Json& value, std::size_t spaces)
{
    const std::string text = value.dump(indent), space(spaces, ' ');
    std::string result;
    for (const char c : text) {
        result += c;
        if (c == '\n') result += space;  // a line end within a string is written as \n
    }
    return result;
}

/// An array or object that is written while its elements are made.
class OpenBrackets {
public:
    OpenBrackets(const TakeText& take, const char* brackets, std::size_t spaces)
        : m_take(take), m_brackets(brackets), m_spaces(spaces)
    {
    }

    /// To be called before the text of each element.
    void next(const std::string& key = {})
    {
        m_take((m_isEmpty ? std::string(1, m_brackets[0]) : ",") + "\n" + std::string(m_spaces + indent, ' ') + key);
        m_isEmpty = false;
    }
    void close() { m_take(m_isEmpty ? m_brackets : "\n" + std::string(m_spaces, ' ') + m_brackets[1]); }

private:
    const TakeText& m_take;
    std::string m_brackets;
    std::size_t m_spaces;
    bool m_isEmpty = true;
};

std::string keyText(const std::string& key) { return Json(key).dump() + ": "; }

void writeValue(const Json& value, std::size_t spaces, const TakeText& take, int depth = 1)
{
    if (!value.is_structured() || depth > deepest) return take(indented(value, spaces));
    OpenBrackets open(take, value.is_object() ? "{}" : "[]", spaces);
    for (const auto& [key, element] : value.items()) {
        open.next(value.is_object() ? keyText(key) : "");
        writeValue(element, spaces + indent, take, depth + 1);
    }
    open.close();
}

void writeRows(const MakeRows& make, const TakeText& take)
{
    OpenBrackets open(take, "[]", indent);
    make([&](const Json& row) {
        open.next();
        take(indented(row, 2 * indent));
    });
    open.close();
}

/// Visits the parts in their order and the collected reasons at the end. `takeMember`: of a JsonMember; `takeValue`: of a key
/// and its value.
template <class TakeMember, class TakeValue>
void visitParts(const JsonParts& parts, const TakeMember& takeMember, const TakeValue& takeValue)
{
    Json why = Json::object();
    for (const auto& part : parts)
        std::visit(
            protocols::Overloaded{
                takeMember,
                [&](const JsonMembers& members) {
                    const Json made = members.make();
                    for (const auto& [key, value] : made.items())
                        if (key == "why")
                            why.update(value);
                        else
                            takeValue(key, value);
                },
            },
            part);
    if (!why.empty()) takeValue("why", why);
}

}  // namespace

Json arrayOf(const MakeRows& rows)
{
    Json array = Json::array();
    rows([&](Json row) { array.push_back(std::move(row)); });
    return array;
}

Json objectOf(const JsonParts& parts)
{
    Json object = Json::object();
    const auto takeMember = [&](const JsonMember& member) {
        object[member.key] = std::visit(protocols::Overloaded{
                                            [](const MakeValue& make) { return make(); },
                                            [](const MakeRows& make) { return arrayOf(make); },
                                        },
                                        member.content);
    };
    visitParts(parts, takeMember, [&](const std::string& key, const Json& value) { object[key] = value; });
    return object;
}

void writeObject(const JsonParts& parts, const TakeText& take)
{
    OpenBrackets open(take, "{}", 0);
    const auto takeMember = [&](const JsonMember& member) {
        open.next(keyText(member.key));
        std::visit(protocols::Overloaded{
                       [&](const MakeValue& make) { writeValue(make(), indent, take); },
                       [&](const MakeRows& make) { writeRows(make, take); },
                   },
                   member.content);
    };
    visitParts(parts, takeMember, [&](const std::string& key, const Json& value) {
        open.next(keyText(key));
        writeValue(value, indent, take);
    });
    open.close();
    take("\n");
}

}  // namespace reports
