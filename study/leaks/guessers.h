// Guessers of the true piece and of the condition of each trial. Each has a name, is deterministic, and uses readable values
// only. Hits are counted against the truth, with a one-sided exact binomial test against chance.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/leaks/seen_study.h"

namespace study::leaks {

/// What the allocation key says about each trial and each stimulus file.
struct Truth {
    struct Shown {
        std::string fabric;
        std::string condition;    ///< "mismatched" for such an anchor, whose condition the protocol says
        std::string anchor = {};  ///< "mismatched" or "repeated"; empty for a presentation of the list, and for a file
    };
    std::vector<Shown> trials;           ///< [trial of SeenStudy]
    std::map<std::string, Shown> files;  ///< by file code
};

/// One guesser and its success.
struct Guess {
    std::string attack;  ///< the way of guessing
    std::string what;    ///< the values that it reads
    std::string target;  ///< "true piece", "condition", "same or different", "anchor", "catch or anchor",
                         ///< "condition of a file", "fabric of a file"
    long long hits = 0;
    long long trials = 0;  ///< guessed at; trials about which the guesser has no opinion are left out
    double chance = 0;
    double p = 1;          ///< P(hits or more) by chance; twice that of the better half where two halves serve each other
    double pAdjusted = 1;  ///< after Holm's correction over all guessers of the report
};

/// The guessers of tray_guessers.h.
std::vector<Guess> guessesByTrays(const SeenStudy& study, const Truth& truth);

/// A number beside each stimulus file.
struct FileMark {
    std::string name;
    std::map<std::string, double> values;  ///< by file code
};
/// The condition (fabric) of the file with the nearest number among the files of half of the fabrics (conditions), for the
/// others.
std::vector<Guess> guessesByFiles(const std::vector<FileMark>& marks, const Truth& truth);

/// Computes pAdjusted.
void correctForNumber(std::vector<Guess*> guesses);

}  // namespace study::leaks
