// A stored study as reports, status and export read it: with K-labels while it is blinded, with the names of the conditions after
// its unblinding is recorded.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "database/keys.h"
#include "database/study_store.h"
#include "reports/data/study_data.h"

namespace study::records {

/// Opens the study for reading. Throws badInput where the folder is no study.
database::StudyStore openStudy(const std::filesystem::path& study);

/// The fabric and the condition of each presentation. The condition is a K-label, or after the unblinding its id. It is empty for
/// a mismatched presentation of a blinded study: the protocol says its condition, so that a label beside it would lose its mask.
struct Naming {
    struct Entry {
        protocols::FabricId fabric;
        std::string condition;
        protocols::InstructionId instruction = {};  ///< of the block; empty where the phase gives none
        std::optional<int> deadlineMs = {};
        protocols::AnchorKind anchor = protocols::AnchorKind::None;
    };
    bool blinded = true;
    std::map<std::pair<protocols::ParticipantId, protocols::TrialNumber>, Entry> entries;
    std::vector<std::string> conditions;  ///< K-labels sorted, or ids in the order of the protocol

    const Entry& of(const protocols::ParticipantId& participant, protocols::TrialNumber trial) const
    {
        return entries.at({participant, trial});
    }
};
/// K-labels with the key before the unblinding, ids after it. Empty where the study is blinded and nobody gives its passphrase.
std::optional<Naming> namingOf(const database::StudyStore& store, const protocols::Protocol& protocol,
                               const database::Passphrase& passphrase);

/// Whether the answer began after the deadline of its block. None without a deadline or without a response time.
std::optional<bool> isLate(const Naming::Entry& entry, const database::CurrentAnswer& answer);

/// As the study was made. Later versions differ in texts, times, bounds and contrasts only (protocols::fixedPartsChanged).
protocols::Protocol protocolOf(const database::StudyFacts& facts);

/// As new participants follow it: the last version that the study took over. Texts, times and questions of facts may differ.
protocols::Protocol latestProtocolOf(const database::StudyStore& store);

/// Field of StudyFacts::signalsJson with sentences about images that cannot show what the study compares. They name conditions
/// and fabrics together, so only reports of an unblinded study show them.
inline constexpr const char* imageWarningsField = "image_warnings";
/// Field of StudyFacts::signalsJson with the prices of the renderings (reports::pricesFromJson).
inline constexpr const char* pricesField = "prices";

/// Whether sentences name the files of a lab's own programs and the displays of sittings; such a name may be a person's.
enum class ProgramFiles { Named, LeftOut };

/// Participants whose answers were erased. They count as withdrawn, and nothing of theirs is kept.
std::set<protocols::ParticipantId> erasedParticipants(const database::StudyStore& store);

/// What the log holds behind the unblinding, in one sentence; empty where there is nothing.
std::string afterUnblindingSentence(const database::StudyStore& store);

/// The sentences that every report must show: those of the study's facts and, where it is so, that images lay open.
std::vector<std::string> stampsOf(const database::StudyStore& store, const database::StudyFacts& facts,
                                  ProgramFiles files = ProgramFiles::Named);

/// The data of the report; empty where the study is blinded and nobody gives its passphrase. Throws badInput for a wrong one,
/// workFailed if the stored study cannot be read.
std::optional<reports::StudyData> studyData(const database::StudyStore& store, const database::Passphrase& passphrase);
/// The same for a caller who has read the answers of the store already.
std::optional<reports::StudyData> studyData(const database::StudyStore& store, const database::Passphrase& passphrase,
                                            const std::vector<database::CurrentAnswer>& answers);

/// What can be known of a running study without its key: the answers, all of one unnamed condition and fabric. Those to catch
/// trials and anchors are among them, because only the key tells them apart. It serves the flags on data quality, except those
/// that compare such answers with the others.
reports::StudyData sealedStudyData(const database::StudyStore& store);
/// The same for a caller who has read the answers of the store already.
reports::StudyData sealedStudyData(const database::StudyStore& store, const std::vector<database::CurrentAnswer>& answers);

}  // namespace study::records
