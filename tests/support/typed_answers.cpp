#include "tests/support/typed_answers.h"

#include <QTest>
#include <algorithm>

#include "study/app/state/rating_text.h"

namespace tests::support {

using protocols::FabricId;
using study::session::GivenAnswer;
using study::session::Presenting;

std::string answerText(const GivenAnswer& response)
{
    const auto* rating = std::get_if<protocols::Tenths>(&response);
    return rating ? study::app::textOf(*rating).toStdString() : study::session::textOf(response);
}

std::vector<database::CurrentAnswer> storedIn(const database::StudyFolder& folder)
{
    return database::StudyStore(folder, database::StudyStore::Access::Read).answers();
}

Answers answersIn(const database::StudyFolder& folder)
{
    Answers answers;
    for (const auto& stored : storedIn(folder)) {
        const auto& record = stored.record;
        answers[stored.participant.value + " " + std::to_string(record.trial.value) + " " + record.question.value] =
            record.answer ? *record.answer : answerText(GivenAnswer(*record.rating));
    }
    return answers;
}

std::string nowAsked(OpenWindow& open)
{
    const int index = std::get<Presenting>(open.view().state.stage).index;
    const auto number = open.gui().plan().trials.at(static_cast<std::size_t>(index)).number;
    return open.view().participant + " " + std::to_string(number.value) + " " + open.view().question->id.value;
}

void pressKey(OpenWindow& open, Qt::Key key) { QTest::keyClick(open.window().focusWidget(), key); }

void typeText(OpenWindow& open, const QString& text) { QTest::keyClicks(open.window().focusWidget(), text); }

void answerByKeys(OpenWindow& open, const GivenAnswer& response, QChar point)
{
    if (std::holds_alternative<protocols::FreeText>(open.view().question->kind))
        QTest::keyClick(open.window().focusWidget(), Qt::Key_T, Qt::AltModifier);  // letters are text on this page
    else
        pressKey(open, Qt::Key_T);
    open.clock().advanceSeconds(2.0);
    enterByKeys(open, response, point);
    pressKey(open, Qt::Key_Return);
}

void enterByKeys(OpenWindow& open, const GivenAnswer& response, QChar point)
{
    if (const auto* fabric = std::get_if<FabricId>(&response)) {
        const auto& tray = open.view().trayIds;
        const auto place = std::find(tray.begin(), tray.end(), *fabric) - tray.begin();
        pressKey(open, static_cast<Qt::Key>(Qt::Key_A + place));
    } else if (const auto* sameness = std::get_if<study::session::Sameness>(&response)) {
        pressKey(open, sameness->same ? Qt::Key_S : Qt::Key_D);
    } else if (std::holds_alternative<protocols::Tenths>(response)) {
        typeText(open, QString::fromStdString(answerText(response)).replace(QLatin1Char('.'), point));
    } else {
        typeText(open, QString::fromStdString(answerText(response)));
    }
}

}  // namespace tests::support
