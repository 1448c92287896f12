// What a report is made of, wherever it comes from (a study's database or a CSV of another
// experiment): responses by participant, fabric and condition, and how to call things.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reports {

/// One participant x fabric x condition x question. Condition: an id, or a K-label while blinded.
struct Response {
    std::string participant;
    std::string fabric;
    std::string condition;
    std::string question;               ///< "Q1"
    std::optional<bool> correct;        ///< choice questions
    std::optional<std::string> answer;  ///< the fabric chosen
    std::optional<int> answerSlot;      ///< 0 = A
    std::optional<double> rating;       ///< scale units
    std::optional<double> seconds;
};

struct QuestionInfo {
    std::string id;
    std::string text;
    bool isChoice = false;  ///< right or wrong: a choice among m, or same/different
    int alternatives = 0;   ///< m of this question's choice; 0: the study's
};

struct StudyData {
    std::string name;
    std::string protocolSha256;
    bool blinded = true;
    bool simulated = false;  ///< any participant simulated: said on every page
    bool scripted = false;
    std::vector<std::string> stamps;  ///< sentences that must be printed
    std::vector<std::string> participants;
    std::vector<std::string> fabrics;
    std::vector<std::string> conditions;  ///< in the order of every table
    std::vector<QuestionInfo> questions;
    int alternatives = 3;  ///< m of the (first) forced choice
    int alternativesOf(const std::string& question) const;
    double scaleMin = 0, scaleMax = 10;
    std::pair<double, double> equivalenceBounds{-0.5, 0.5};
    std::vector<std::pair<std::string, std::string>> planned;  ///< empty while blinded
    std::vector<Response> responses;
    std::vector<Response> catchResponses;  ///< to blank glass; in no analysis, flags alone look at them
    std::vector<std::string> withdrawn;    ///< participants who withdrew; their answers are not analysed
    std::string participantsSentence;      ///< who took part, by the facts they gave; empty: none were asked
    std::size_t voided = 0;                ///< presentations kept but not analysed
    std::size_t expectedResponses = 0;     ///< of a complete study; 0: unknown
    std::string signalsJson;               ///< generated against measured (signal_quality.h); empty while blinded
};

}  // namespace reports
