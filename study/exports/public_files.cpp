#include "study/exports/public_files.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <string_view>
#include <variant>

#include "protocols/files/safe_text.h"
#include "protocols/files/utf8.h"
#include "study/records/stored_study.h"

namespace study::exports {

namespace {

/// A scalar of YAML in double quotes. Control characters, byte order marks and the line ends of Unicode are written as numbers,
/// because YAML takes them for no text or for the end of a line.
std::string yamlText(std::string_view text)
{
    std::string yaml = "\"";
    while (!text.empty()) {
        const std::size_t length = std::max(std::size_t{1}, protocols::utf8Length(text));
        const char32_t c = length > 1 ? protocols::utf8Character(text) : static_cast<unsigned char>(text.front());
        if (c < 0x20 || (c >= 0x7f && c < 0xa0) || c == 0x2028 || c == 0x2029 || c == 0xfeff) {
            char number[12];
            std::snprintf(number, sizeof number, "\\u%04x", static_cast<unsigned>(c));
            yaml += number;
        } else {
            if (c == U'"' || c == U'\\') yaml += '\\';
            yaml += text.substr(0, length);
        }
        text.remove_prefix(length);
    }
    return yaml + "\"";
}

}  // namespace

std::string licenceText(const std::string& study, const std::string& spdx)
{
    return "The tables of the study \"" + protocols::printable(study) + "\" in this folder are under the licence " + spdx +
           ".\nIts text: https://spdx.org/licenses/" + spdx + ".html\n";
}

std::string citationText(const std::string& study, const std::string& spdx, const std::vector<std::string>& authors,
                         const std::string& released)
{
    std::string text =
        "cff-version: 1.2.0\nmessage: \"If you use these data, please cite them as below.\"\ntype: dataset\ntitle: " +
        yamlText(study) + "\nlicense: " + yamlText(spdx) + "\ndate-released: " + yamlText(released) + "\nauthors:\n";
    for (const std::string& author : authors) text += "  - name: " + yamlText(author) + "\n";
    if (authors.empty()) text += "  - name: \"NAME THE AUTHORS HERE\"\n";
    return text;
}

bool isWorded(const protocols::Protocol& protocol, const protocols::QuestionId& question)
{
    const auto* known = questionWith(protocol, question);
    return known == nullptr || std::holds_alternative<protocols::FreeText>(known->kind);
}

LeftOutAnswers answersLeftOut(const database::StudyStore& store)
{
    const auto protocol = records::protocolOf(store.facts());
    std::set<protocols::ParticipantId> withdrawn;
    for (const auto& enrolment : store.enrolments())
        if (enrolment.state == database::SlotState::Withdrawn) withdrawn.insert(enrolment.participant);
    LeftOutAnswers leftOut;
    store.eachAnswer([&](const database::CurrentAnswer& answer) {
        if (withdrawn.contains(answer.participant))
            ++leftOut.ofWithdrawn;
        else
            leftOut.inWords += isWorded(protocol, answer.record.question) ? 1 : 0;
    });
    return leftOut;
}

}  // namespace study::exports
