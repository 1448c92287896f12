// What a report is made from, wherever it comes from (a study's database, or a CSV of another experiment): the answers by
// participant, fabric, condition and question, and what the study is.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocols/answer_kind.h"
#include "reports/data/registration.h"
#include "reports/data/rendering_price.h"
#include "reports/data/signal_comparison.h"

namespace reports {

/// A choice, and whether it was right. `answer` and `slot` are missing where only right and wrong were recorded.
struct ChosenAnswer {
    bool correct = false;
    std::optional<std::string> answer;  ///< the fabric chosen, or "same" or "different"
    std::optional<int> slot;            ///< place on the tray, 0 = A
};

struct RatedAnswer {
    double rating = 0;  ///< scale units
};

struct WordedAnswer {
    std::string words;
};

using AnswerContent = std::variant<ChosenAnswer, RatedAnswer, WordedAnswer>;

/// One participant x fabric x condition x question x repetition.
struct StudyResponse {
    std::string participant;
    std::string fabric;
    std::string condition;  ///< an id, or a K-label while the study is blinded
    std::string question;   ///< "Q1"
    AnswerContent content;
    std::optional<double> seconds = {};  ///< as recorded; the analysis reads it through responseTimeOf()
    std::optional<int> entries = {};     ///< of a second entry: entries until two agreed
    std::string touchedBy = {};          ///< "display" or "operator"; empty: no touch was stamped
    std::string repetition = {};         ///< name of the repetition and session; empty where a cell is asked once
    std::optional<int> trial = {};       ///< place in the participant's running order, from 1
    std::optional<int> sitting = {};     ///< number of times that the session was opened, from 1
    std::string instruction = {};        ///< of the block, "speed"; empty where none was given
    std::optional<bool> late = {};       ///< given after the deadline of the block; none without a deadline or a time
};

/// What the times of a study are.
enum class TimesTaken {
    ToBeginning,  ///< from the first touch to the beginning of the answer: the participant's time
    ToEntry,      ///< to the entry of the answer, because whole sittings lack the stamp of its beginning, as in older versions
    AsRecorded,   ///< another laboratory's file states them
};

/// How the answers to a question are analysed. Several kinds of answer can share one scoring.
struct RightOrWrong {
    int alternatives = 3;          ///< answers of which one is right
    bool isSameDifferent = false;  ///< the answers are "same" and "different": sensitivity is that of hits and false alarms
    bool operator==(const RightOrWrong&) const = default;
};
struct NumberOnScale {
    double min = 0;
    double max = 10;
    bool operator==(const NumberOnScale&) const = default;
};
struct OpenWords {
    bool operator==(const OpenWords&) const = default;
};
using Scoring = std::variant<RightOrWrong, NumberOnScale, OpenWords>;

/// The only place of the report that knows the kinds of answer one by one.
Scoring scoringOf(const protocols::AnswerKind& kind);

/// One wording of a sentence that was read to participants, where the protocol was amended between them.
struct SentenceWording {
    std::string text;
    std::vector<int> versions;  ///< of the protocol
    std::vector<std::string> participants;
};

/// What a block asked of the participant's speed: one level of the factor "instruction".
struct InstructionInfo {
    std::string id;
    std::string text = {};  ///< the sentence that was said; empty: unknown
    std::optional<double> deadlineSeconds = {};
    std::vector<SentenceWording> wordings = {};  ///< several ones; empty where `text` is the only one
};

struct QuestionInfo {
    std::string id;
    std::string text;  ///< of several wordings, the last one
    protocols::AnswerKind kind;
    std::vector<InstructionInfo> instructions = {};  ///< in the order of every table; empty: none were given
    std::size_t answersPerCell = 0;                  ///< most answers by one participant x fabric x condition; 0: as in the study
    std::size_t presentations = 0;                   ///< to a participant, with catch trials and anchors; 0: those of all cells
    std::vector<SentenceWording> wordings = {};      ///< several ones; empty where `text` is the only one
    bool alternativesAssumed = false;                ///< nobody stated how many alternatives a choice had: the default is taken
    bool scaleAssumed = false;                       ///< nobody stated the scale of the ratings: 0 to 10 is taken
};

/// A version of an amended protocol.
struct FollowedVersion {
    int version = 1;
    std::string sha256;
    std::size_t participants = 0;  ///< analysed ones with answers who followed it
};

/// What a display measured of the finger in one presentation. A value is missing where it has no sensor, or saw too little.
struct TouchedPresentation {
    std::string participant;
    std::string condition;
    double contactSeconds = 0;
    std::optional<double> speedMmPerS;  ///< length of the path through the time in contact
    std::optional<double> forceN;       ///< mean over the time in contact
};

/// One run of the latency task: how long the operator takes from a signal to a key.
struct OperatorTaps {
    std::string operatorName;
    std::string wallTime;
    std::string signal;  ///< "tone" or "flash"
    int taps = 0, misses = 0, anticipations = 0;
    std::optional<double> medianMs, q1Ms, q3Ms;  ///< none without taps
};

/// The middle of a friction image, pixel by pixel.
struct FrictionPicture {
    std::string condition;
    std::string fabric;
    std::string pngBase64;
};

/// Size of these pictures, pixels of the display.
inline constexpr int pictureWidth = 112, pictureHeight = 70;

struct StudyData {
    std::string name;
    std::string protocolSha256;
    bool blinded = true;
    bool simulated = false;  ///< any participant is simulated; every section of the page says so
    bool scripted = false;
    bool knowsKinds = true;           ///< false: a table of answers that does not tell whether people answered
    std::vector<std::string> stamps;  ///< sentences that the page must print
    std::vector<std::string> participants;
    std::set<std::string> finished;  ///< participants who gave every answer and ended; only blinded reports read it
    std::size_t openPlaces = 0;      ///< running orders without such a participant; only blinded reports read it
    std::vector<std::string> fabrics;
    std::vector<std::string> conditions;         ///< in the order of every table
    std::size_t answersPerCell = 1;              ///< most answers to one question by one participant x fabric x condition
    bool everyPair = false;                      ///< all pairs of conditions are asked for, however many there are
    std::map<std::string, std::string> groupOf;  ///< group of each participant; empty: there are no groups
    std::vector<QuestionInfo> questions;
    std::pair<double, double> equivalenceBounds{-0.5, 0.5};
    PlanOrigin boundsFrom = PlanOrigin::Program;
    std::vector<std::pair<std::string, std::string>> planned;  ///< the primary one first; empty while blinded
    PlanOrigin plannedFrom = PlanOrigin::Protocol;             ///< what states them, where there are any
    std::optional<PlannedDesign> plannedDesign;                ///< none: neither a registered plan nor a protocol is known
    bool hasLog = false;                            ///< false: nobody could have registered a plan that this program knows
    std::vector<Registration> registrations;        ///< in their order
    std::string protocolInUse;                      ///< SHA-256 of the latest protocol of the study
    std::vector<FollowedVersion> protocolVersions;  ///< empty where the protocol was never amended
    /// Version of an amended protocol that states the plan, because no registration is followed; 0: there is no need to say it.
    int planVersion = 0;
    std::vector<std::string> protocolChanges;  ///< parts in which it differs from the plan, which counts: "equivalence bounds"
    std::vector<std::string> changedTexts;     ///< those in which it was followed all the same: "wording of Q2"
    std::vector<StudyResponse> responses;
    std::vector<StudyResponse> catchResponses;  ///< to blank glass; only quality flags use them
    /// To the image of `fabric` with another fabric on the tray; `condition` is empty while the study is blinded.
    std::vector<StudyResponse> mismatchedResponses;
    std::vector<StudyResponse> repeatedResponses;  ///< to presentations that came a second time
    std::set<std::string> choicesRepeatedAnew;     ///< questions whose choices had other foils the second time
    std::vector<std::string> withdrawn;            ///< participants who withdrew; their answers are not analysed
    std::vector<std::string> erased;               ///< participants whose answers were erased; they are not in `withdrawn`
    std::string participantsSentence;              ///< who took part, by the facts they gave; empty: none were asked
    std::vector<TouchedPresentation> touches;      ///< analysed presentations with samples of the finger
    std::vector<OperatorTaps> operatorTaps;        ///< in the order of the log
    TimesTaken times = TimesTaken::AsRecorded;     ///< what `seconds` of the responses is
    std::size_t voided = 0;                        ///< presentations; a table of answers knows only those with answers
    /// Number in a complete study, while it is blinded with those to catch trials and anchors; 0: unknown.
    std::size_t expectedResponses = 0;
    std::size_t expectedOfEmptyPlaces = 0;    ///< part of expectedResponses: of running orders that nobody has
    std::optional<SignalComparison> signals;  ///< none while blinded
    std::vector<RenderingPrice> prices;       ///< empty while blinded, and where no condition carries a quality
    std::vector<FrictionPicture> pictures;    ///< empty while blinded, and where the images are not at hand
};

/// Number of participants with an analysed answer. All of them where the data hold no answers: in a blinded report, and of a
/// simulation in memory.
std::size_t answeringParticipants(const StudyData& data);

/// Whether the answers are numbers, or right and wrong; words are neither.
bool hasNumbers(const QuestionInfo& question);

/// Most answers to this question by one participant x fabric x condition.
std::size_t answersPerCellOf(const StudyData& data, const QuestionInfo& question);

/// Number of alternatives of the first question with right and wrong answers; the paper's 3 without such a question.
int firstAlternatives(const StudyData& data);

}  // namespace reports
