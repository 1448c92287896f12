#include "study/app/state/answer_form.h"

#include "study/app/language/app_text.h"
#include "study/app/state/rating_text.h"

namespace study::app {

using session::GivenAnswer;

namespace {

OptionsForm optionsOfTray(const std::vector<protocols::FabricId>& tray, const std::vector<std::string>& pieces)
{
    OptionsForm form;
    for (std::size_t place = 0; place < tray.size(); ++place) {
        const QString letter = slotLetter(place), name = nameOfPiece(pieces.at(place));
        form.options.push_back({tray[place], letter, name, QStringLiteral("%1    %2").arg(letter, name),
                                AppText::tr("“%1.” (%2)").arg(letter, name)});
    }
    return form;
}

OptionsForm sameOrDifferent()
{
    const QString same = AppText::tr("Same"), different = AppText::tr("Different");
    // The keys are S and D in every language, like all keys of the program.
    return {
        {{session::Sameness{true}, QStringLiteral("S"), same, same, AppText::tr("“%1.”").arg(same.toLower())},
         {session::Sameness{false}, QStringLiteral("D"), different, different, AppText::tr("“%1.”").arg(different.toLower())}}};
}

QString wordsOf(const GivenAnswer& response) { return QString::fromStdString(std::get<session::Words>(response).text); }

bool agree(const GivenAnswer& first, const GivenAnswer& second)
{
    const bool areWords = std::holds_alternative<session::Words>(first) && std::holds_alternative<session::Words>(second);
    return areWords ? wordsOf(first).simplified() == wordsOf(second).simplified() : first == second;
}

}  // namespace

AnswerForm formOf(const session::View& view)
{
    return view.question ? formOf(view.question->kind, view.trayIds, view.tray) : AnswerForm();
}

AnswerForm formOf(const protocols::AnswerKind& kind, const std::vector<protocols::FabricId>& tray,
                  const std::vector<std::string>& pieces)
{
    return std::visit(
        protocols::Overloaded{[&](const protocols::ForcedChoice&) -> AnswerForm { return optionsOfTray(tray, pieces); },
                              [](const protocols::Rating& rating) -> AnswerForm { return ScaleForm{rating.scale}; },
                              [](const protocols::SameDifferent&) -> AnswerForm { return sameOrDifferent(); },
                              [](const protocols::FreeText&) -> AnswerForm { return WordsForm{}; }},
        kind);
}

void readBackInWords(AnswerForm& form, const QString& same, const QString& different)
{
    auto* choice = std::get_if<OptionsForm>(&form);
    if (!choice) return;
    for (AnswerOption& option : choice->options)
        if (const auto* said = std::get_if<session::Sameness>(&option.response))
            option.readBack = AppText::tr("“%1.”").arg(said->same ? same : different);
}

QString textOf(const AnswerForm& form, const GivenAnswer& response)
{
    if (const auto* rating = std::get_if<protocols::Tenths>(&response)) return textOf(*rating);
    if (const auto* choice = std::get_if<OptionsForm>(&form))
        for (const AnswerOption& option : choice->options)
            if (option.response == response) return option.shown;
    return QString::fromStdString(session::textOf(response));
}

QString nameOfPiece(const std::string& code) { return AppText::tr("Piece %1").arg(QString::fromStdString(code)); }

QString disagreement(const AnswerForm& form, const GivenAnswer& first, const GivenAnswer& second)
{
    if (agree(first, second)) return {};
    return AppText::tr("The two entries differ: “%1” and “%2”. Ask the participant again, then enter the answer twice.")
        .arg(textOf(form, first).simplified(), textOf(form, second).simplified());
}

}  // namespace study::app
