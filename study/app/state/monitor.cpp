#include "study/app/state/monitor.h"

#include <QDateTime>
#include <algorithm>
#include <set>

#include "database/server/study_move.h"
#include "protocols/protocol_json.h"
#include "study/app/language/app_text.h"
#include "study/session/driver.h"
#include "study/session/session_moves.h"
#include "study/session/session_record.h"

namespace study::app {

using namespace session;

namespace {

struct StageText {
    const Plan& plan;
    QString operator()(const Enrolled&) const { return AppText::tr("welcome"); }
    QString operator()(const Consenting&) const { return AppText::tr("consent"); }
    QString operator()(const AskingFacts&) const { return AppText::tr("facts"); }
    QString operator()(const Familiarising&) const { return AppText::tr("familiarisation"); }
    QString operator()(const ScaleTraining&) const { return AppText::tr("scale"); }
    QString operator()(const CheckingList&) const { return AppText::tr("checklist"); }
    QString operator()(const PlacingTray&) const { return AppText::tr("tray"); }
    QString operator()(const Presenting& asked) const
    {
        return AppText::tr("question %1").arg(QString::fromStdString(questionOf(plan, asked.index, asked.question).id.value));
    }
    QString operator()(const OnBreak&) const { return AppText::tr("break"); }
    QString operator()(const Debriefing&) const { return AppText::tr("debriefing"); }
    QString operator()(const Finished&) const { return AppText::tr("finished"); }
    QString operator()(const Withdrawn&) const { return AppText::tr("withdrawn"); }
};

QString stageText(const Plan& plan, const State& state)
{
    const QString stage = std::visit(StageText{plan}, state.stage);
    return state.paused ? AppText::tr("paused (%1)").arg(stage) : stage;
}

/// State after all events of the log. Events that this version refuses are skipped.
State stateAfter(const Plan& plan, const std::vector<database::EventRecord>& log)
{
    State state;
    for (const database::EventRecord& record : log) {
        auto outcome =
            apply(plan, state, {eventFromRecord(record.kind, record.payloadJson), record.atNs, session::EventSource::Log});
        if (auto* step = std::get_if<SessionStep>(&outcome)) state = std::move(step->next);
    }
    return state;
}

int missingCells(const Plan& plan, const State& state)
{
    std::set<int> passed;
    for (int position = 0; position < state.position && position < static_cast<int>(state.order.size()); ++position)
        passed.insert(state.order[static_cast<std::size_t>(position)].index);
    int missing = 0;
    for (const int index : passed) missing += questionsOf(plan, index) - answersTo(state, index);
    return missing;
}

std::optional<double> minutesBetween(const std::string& earlier, const std::string& later)
{
    const auto from = QDateTime::fromString(QString::fromStdString(earlier), Qt::ISODateWithMs);
    const auto to = QDateTime::fromString(QString::fromStdString(later), Qt::ISODateWithMs);
    if (!from.isValid() || !to.isValid()) return std::nullopt;
    return static_cast<double>(from.msecsTo(to)) / 60000.0;
}

bool isErased(const database::StudyStore& store, const protocols::ParticipantId& participant)
{
    const auto erasures = store.erasures();
    return std::any_of(erasures.begin(), erasures.end(), [&](const database::Erasure& erasure) {
        return erasure.answersToo && erasure.participant == participant;
    });
}

MonitorOverview::ParticipantRow rowOf(const database::StudyStore& store, const database::Enrolment& one, const std::string& now)
{
    MonitorOverview::ParticipantRow row;
    row.place = one.slot;
    row.state = one.state;
    row.kind = one.kind;
    row.participant = QString::fromStdString(one.participant.value);
    if (isErased(store, one.participant)) {
        row.stage = AppText::tr("erased");
        return row;
    }
    const Plan plan = readPlan(store, one.participant);
    const auto log = store.events(one.participant);
    const State state = stateAfter(plan, log);
    row.stage = stageText(plan, state);
    row.presentations = static_cast<int>(state.order.empty() ? plan.trials.size() : state.order.size());
    row.presentation = std::min(state.position + 1, row.presentations);
    row.answers = static_cast<int>(state.answers.size());
    row.answersInAll = plan.protocol.answersPerParticipant();
    row.missing = missingCells(plan, state);
    row.voided = row.presentations - static_cast<int>(plan.trials.size());
    if (!log.empty()) row.minutesSinceEvent = minutesBetween(log.back().wallTime, now);
    return row;
}

}  // namespace

database::StudyStore readMonitored(const std::filesystem::path& study) { return database::readStudy({study}); }

MonitorOverview monitorOverview(const database::StudyStore& store, const std::string& now)
{
    MonitorOverview seen;
    const auto facts = store.facts();
    seen.study = QString::fromStdString(facts.name);
    seen.isBlinded = !store.unblinding();
    const auto protocol = protocols::keptProtocolFromJson(store.protocolVersions().back().json,
                                                          store.folder().protocol().string(), facts.programVersion);
    const auto enrolments = store.enrolments();
    for (const database::Slot& slot : store.slots()) {
        for (const database::Enrolment& one : enrolments)
            if (one.slot == slot.number) seen.rows.push_back(rowOf(store, one, now));
        if (slot.state == database::SlotState::Free) seen.rows.push_back({.place = slot.number});
        seen.answersInAll += protocol.answersPerParticipant();
    }
    for (const MonitorOverview::ParticipantRow& row : seen.rows)
        if (row.state != database::SlotState::Withdrawn) seen.answers += row.answers;
    return seen;
}

}  // namespace study::app
