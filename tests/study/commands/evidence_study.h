// A study with human participants for the tests of evidence.
#pragma once

#include <QFile>
#include <QString>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "protocols/files/csv_table.h"
#include "tests/support/played_session.h"
#include "tests/support/study_builder.h"

namespace tests::evidence {

inline const std::string askingProtocol = R"({
  "schema": "vis2hap.protocol/1", "name": "A <study> of touch", "participants": 2, "fabrics": ["F01", "F02", "F03"],
  "conditions": ["v_grey", "h&f"],
  "phases": [{"questions": ["Q1"], "alternatives": 3},
             {"questions": ["Feel", "Why"], "scale": {"min": 1, "max": 7, "step": 0.5, "sections": 1}, "free_text": ["Why"]},
             {"questions": ["Same"], "same_different": true}],
  "question_texts": {"Feel": "How close is it?", "Why": "What did you feel?", "Same": "Is it the same?"},
  "facts": ["age"], "consent": "I agree to take part."
})";

inline QString bytesOf(const QString& file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? QString::fromUtf8(opened.readAll()) : QString();
}

inline nlohmann::json jsonOf(const QString& file) { return nlohmann::json::parse(bytesOf(file).toStdString()); }

inline protocols::CsvTable tableOf(const QString& file)
{
    return protocols::csvTableFrom(bytesOf(file).toStdString(), file.toStdString());
}

/// The cell of the row in this column.
inline QString cell(const protocols::CsvTable& table, std::size_t row, const std::string& column)
{
    const auto at = std::ranges::find(table.columns, column) - table.columns.begin();
    return QString::fromStdString(table.rows.at(row).at(static_cast<std::size_t>(at)));
}

/// P1 finished, with a note, a correction and a voided presentation; P2 is on the way.
inline void playStudy(const std::string& folder, const std::string& protocol = askingProtocol)
{
    support::buildStudy(folder, {.protocol = protocol});
    {
        support::OpenSession first({folder}, "P1", database::ParticipantKind::Human, {"Ada", "test", "here"});
        first.stepUntil("Presenting");
        first.send(study::session::Touched{study::session::TouchSource::Display});
        first.clock.advanceSeconds(3);
        const auto next = support::nextEvent(first.driver->view(), first.driver->plan());
        first.send(study::session::Answered{std::get<study::session::Answered>(*next).response,
                                            {.begunAgoNs = 1000000000, .touchEndedAgoNs = 500000000}});
        first.playUntilAnswers(2);
        first.stepUntil("Presenting");
        first.send(study::session::Noted{"smells of <glue>", true});
        first.send(study::session::Voided{"wrong piece"});
        first.playUntilAnswers(4);
        first.playToEnd();
    }
    support::OpenSession({folder}, "P2", database::ParticipantKind::Human).playUntilAnswers(3);
}

/// "12:ab34…", the head of the log.
inline QString headIn(const QString& study)
{
    const database::StudyStore store({study.toStdString()}, database::StudyStore::Access::Read);
    return QString::fromStdString(textOf(store.head()));
}

}  // namespace tests::evidence
