#include "tests/fuzz/answer_readers.h"

#include <cmath>
#include <variant>

#include "protocols/protocol_json.h"
#include "reports/data/answers_csv.h"
#include "tests/fuzz/inputs.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;

/// Tables of this size take a second with sanitizers.
constexpr std::size_t largestTable = 1 << 13;

const protocols::Protocol& askedProtocol()
{
    static const protocols::Protocol read = protocols::protocolFromJson(
        R"({"schema": "vis2hap.protocol/1", "name": "asked", "participants": 4, "fabrics": ["F01", "F02"],
            "conditions": ["v_grey", "h&f"], "planned": [["h&f", "v_grey"]], "phases": [{"questions": ["Q1"], "alternatives": 2},
            {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})",
        "protocol.json");
    return read;
}

/// As `report --from` calls the reader: alone, with --map, with --scale and --bounds, with --protocol.
std::vector<reports::AnswersCsvOptions> calls()
{
    std::vector<reports::AnswersCsvOptions> calls(4);
    calls[1].rows.names = {{"participant", "vp"}, {"fabric", "stoff"}, {"condition", "bed"}, {"correct", "hit"}};
    calls[2].scale = protocols::RatingScale{};
    calls[2].scale->max = protocols::Tenths{1000};
    calls[2].equivalenceBounds = {-0.5, 0.5};
    calls[2].alternatives = 2;
    calls[3].protocol = askedProtocol();
    for (auto& call : calls) call.note = [](const std::string&) {};
    return calls;
}

void checkAnswers(const reports::StudyData& data)
{
    for (const auto* responses : {&data.responses, &data.mismatchedResponses, &data.repeatedResponses, &data.catchResponses})
        for (const auto& response : *responses) {
            require(!response.participant.empty() && !response.fabric.empty() && !response.condition.empty(),
                    "an answer without a participant, a fabric or a condition was read");
            if (const auto* rated = std::get_if<reports::RatedAnswer>(&response.content))
                require(std::isfinite(rated->rating), "a rating that is not finite was read");
            require(!response.trial || *response.trial > 0, "an impossible trial was read");
        }
}

/// A first digit chooses the call; without one it is the plain one.
void readAnswers(const fs::path& file, const std::string& bytes)
{
    static const auto all = calls();
    const bool isChosen = !bytes.empty() && bytes[0] >= '0' && bytes[0] <= '3';
    put(file, isChosen ? bytes.substr(1) : bytes);
    checkAnswers(reports::readAnswersCsv(file, all[isChosen ? static_cast<std::size_t>(bytes[0] - '0') : 0]));
}

const std::string ownExport =
    "participant,kind,phase,presentation,presentation_code,fabric,condition,question,alternatives,answer,correct,rating,"
    "ready_at,touched_at,answer_begun_at,answered_at,response_seconds,stored_at,touched_by,corrections,entries,place,attempt,"
    "sitting,state,anchor\n"
    "P01,human,1,1,A1,F01,h&f,Q1,\"[\"\"F01\"\",\"\"F02\"\"]\",F01,1,,1,2,3,4,2.5,5,display,0,1,1,1,1,finished,\n"
    "P01,human,1,2,A2,F02,v_grey,Q1,\"[\"\"F01\"\",\"\"F02\"\"]\",F01,0,,1,2,3,4,3.5,5,operator,0,1,2,1,1,finished,\n"
    "P01,human,2,3,A3,F01,h&f,Q2,[],,,6.5,1,2,3,4,1.5,5,display,0,1,3,1,1,finished,repeated\n"
    "P02,human,2,3,A4,F01,h&f,Q2,[],,,4,1,2,3,4,1.5,5,display,0,1,3,1,1,withdrawn,\n";

}  // namespace

std::vector<Reader> answerReaders(const fs::path& folder)
{
    return {
        {"other-answers",
         {"participant,fabric,condition,Q1_correct,Q2,Q3,Q4\nP1,F01,h&f,1,5,3,2.5\nP1,F02,v_grey,0,4,NA,1\n"
          "P2,F01,h_g+f_g,1,9,0,10\n",
          "participant,fabric,condition,question,correct,rating,answer,seconds,repetition,session,group,trial,sitting,voided\n"
          "P1,F01,h,Q1,true,,,2.5,1,1,a,1,1,\nP1,F01,h,Q2,,6.5,,1.5,1,1,a,1,1,\nP2,F01,h,Q5,,,soft,2,1,1,b,1,1,0\n"
          "P2,F02,h,Q1,false,,,2.5,1,1,b,2,1,1\n",
          "1vp;stoff;bed;hit;Q2;Q1_seconds;instruction;trial\nP1;Leinen;h;wahr;4,5;2,25;speed;1\nP1;Leinen;h;falsch;5,5;1,5;"
          "accuracy;2\n",
          "participant,fabric,condition,rating,anchor\nP1,F01,h,6,\nP1,F01,h,7,repeated\nP1,F02,h,1,mismatched\n",
          "2participant,fabric,condition,Q2,Q2_seconds,Q2_trial,Q2_sitting,extra\nP1,F01,h&f,55,1,1,1,x\nP1,F02,h&f,10,2,2,1,y\n",
          "3participant,fabric,condition,Q1_correct,Q2\nP1,F01,h&f,1,5\nP2,F02,v_grey,0,4.5\n", ownExport},
         [file = folder / "answers.csv"](const std::string& bytes) { readAnswers(file, bytes); },
         {},
         largestTable}};
}

}  // namespace fuzz
