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
        std::string fabric, condition;
    };
    std::vector<Shown> trials;           ///< [trial of SeenStudy]
    std::map<std::string, Shown> files;  ///< by file code
};

/// One guesser and its success.
struct Guess {
    std::string attack;  ///< the way of guessing
    std::string what;    ///< the values that it reads
    std::string target;  ///< "true piece", "condition", "same or different", "condition of a file", "fabric of a file"
    long long hits = 0;
    long long trials = 0;  ///< guessed at; trials about which the guesser has no opinion are left out
    double chance = 0;
    double p = 1;          ///< P(hits or more) by chance; twice that of the better half where two halves serve each other
    double pAdjusted = 1;  ///< after Holm's correction over all guessers of the report
};

/// Guesses at the true pieces and the conditions by each value:
/// - equal values of a choice trial and a rating trial (whole, beginnings, ends, lengths), the nearest by order, the nearest by
///   differing letters, and all letters together; the rating trial's tray names the fabric;
/// - a value that names a piece of the tray, or whose number modulo the slots is the slot;
/// - learned from the truth about the other half of the slots: value -> slot, fabric, condition, and the nearest value's.
/// The last is more than an operator has. It finds any dependence without knowing its form.
std::vector<Guess> guessesByValues(const SeenStudy& study, const std::vector<Feature>& features, const Truth& truth);

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
