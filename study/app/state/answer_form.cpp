#include "study/app/state/answer_form.h"

#include <QCoreApplication>
#include <algorithm>

#include "study/app/state/rating_text.h"

namespace study::app {

using protocols::PhaseAnswer;
using session::Response;

namespace {

QString tr(const char* text) { return QCoreApplication::translate("study::app::AnswerForm", text); }

std::vector<AnswerForm::Option> optionsOfTray(const std::vector<protocols::FabricId>& tray,
                                              const std::vector<std::string>& pieces)
{
    std::vector<AnswerForm::Option> options;
    for (std::size_t place = 0; place < tray.size(); ++place)
        options.push_back({tray[place], slotLetter(place), nameOfPiece(pieces.at(place)), slotLetter(place)});
    return options;
}

std::vector<AnswerForm::Option> sameOrDifferent()
{
    // The keys stay S and D in every language, as the other keys of the program do.
    return {{session::Sameness{true}, QStringLiteral("S"), tr("Same"), tr("same")},
            {session::Sameness{false}, QStringLiteral("D"), tr("Different"), tr("different")}};
}

QString wordsOf(const Response& response) { return QString::fromStdString(std::get<session::Words>(response).text); }

bool agree(const Response& first, const Response& second)
{
    const bool areWords = std::holds_alternative<session::Words>(first) && std::holds_alternative<session::Words>(second);
    return areWords ? wordsOf(first).simplified() == wordsOf(second).simplified() : first == second;
}

}  // namespace

AnswerForm formOf(const session::View& view)
{
    return formOf(view.answerKind.value_or(PhaseAnswer::Choice), view.trayIds, view.tray, view.scale);
}

AnswerForm formOf(PhaseAnswer kind, const std::vector<protocols::FabricId>& tray, const std::vector<std::string>& pieces,
                  const std::optional<protocols::Scale>& scale)
{
    switch (kind) {
        case PhaseAnswer::Choice:
            return {kind, optionsOfTray(tray, pieces), std::nullopt};
        case PhaseAnswer::Rating:
            return {kind, {}, scale};
        case PhaseAnswer::SameDifferent:
            return {kind, sameOrDifferent(), std::nullopt};
        case PhaseAnswer::Words:
            return {kind, {}, std::nullopt};
    }
    return {};
}

QString textOf(const AnswerForm& form, const Response& response)
{
    if (const auto* rating = std::get_if<protocols::Tenths>(&response)) return textOf(*rating);
    const auto option = std::find_if(form.options.begin(), form.options.end(),
                                     [&](const AnswerForm::Option& one) { return one.response == response; });
    if (option == form.options.end()) return QString::fromStdString(session::textOf(response));
    return form.kind == PhaseAnswer::Choice ? QStringLiteral("%1    %2").arg(option->letter, option->name) : option->name;
}

QString nameOfPiece(const std::string& code) { return tr("Piece %1").arg(QString::fromStdString(code)); }

QString disagreement(const AnswerForm& form, const Response& first, const Response& second)
{
    if (agree(first, second)) return {};
    return tr("The two entries differ: “%1” and “%2”. Ask the participant again; both entries start over.")
        .arg(textOf(form, first).simplified(), textOf(form, second).simplified());
}

}  // namespace study::app
