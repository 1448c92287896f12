// The answers of an unblinded study as exports write them, one row an answer.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "database/study_store.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol.h"
#include "study/records/places_in_time.h"
#include "study/records/stored_study.h"

namespace study::exports {

/// A value of an answer; none where it does not exist.
using ExportedValue = std::variant<std::monostate, std::int64_t, double, std::string, std::vector<std::string>>;

struct ExportedField {
    const char* name;
    ExportedValue value;
};

/// Never holds all answers: of a large study only the places of the presentations.
class ExportedAnswers {
public:
    /// Reads the places. `isPublic`: without private columns, words, and answers of participants who withdrew, and with stamps
    /// that count from the first presentation of each sitting. The references must outlive this. Throws workFailed where an
    /// answer belongs to no presentation or participant of the study.
    ExportedAnswers(const database::StudyStore& store, const protocols::Protocol& protocol, const records::Naming& naming,
                    bool isPublic);

    /// Of answers.csv, in their order.
    std::vector<std::string> columns() const;
    void writeCsv(const protocols::TakeBytes& take) const;
    /// An array with an object for each answer, as a member of an object.
    void writeJson(const protocols::TakeBytes& take) const;

private:
    /// Answers that came since the places were read are left out.
    void eachAnswer(const std::function<void(const database::CurrentAnswer&)>& take) const;
    std::vector<ExportedField> rowOf(const database::CurrentAnswer& answer) const;
    bool isLeftOut(const database::CurrentAnswer& answer) const;

    const database::StudyStore& m_store;
    const protocols::Protocol& m_protocol;
    const records::Naming& m_naming;
    bool m_isPublic;
    records::Places m_places;
    std::map<protocols::ParticipantId, database::Enrolment> m_enrolments;
    /// Of a public export: when the first presentation of a sitting was ready. The raw clock runs since the computer was started,
    /// so that stamps of several people would tell days and times.
    std::map<std::pair<protocols::ParticipantId, int>, std::int64_t> m_beganAtNs;
};

}  // namespace study::exports
