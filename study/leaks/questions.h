// What guessers are asked about the trials of a study, and what they know beforehand.
#pragma once

#include <string>
#include <vector>

#include "study/leaks/guessers.h"

namespace study::leaks {

/// What a guess can be. Classes are numbers: of a fabric, of a place on the tray, or of a condition.
struct TrialQuestion {
    std::string target;
    std::vector<std::size_t> trials;        ///< guessed at
    std::vector<std::vector<int>> classes;  ///< [of those trials]
    std::vector<std::size_t> truth;         ///< index into its classes
    std::vector<double> chance;
    int kinds = 0;  ///< number of different classes
};

/// The true piece of each choice trial, among the fabrics on its tray.
TrialQuestion pieces(const SeenStudy& study, const Truth& truth);

/// The same question with the places on the tray as classes.
TrialQuestion places(TrialQuestion question);

/// The condition of every trial. The chance is the share of the commonest condition.
TrialQuestion conditions(const SeenStudy& study, const Truth& truth);
/// The names of the classes of conditions(), in their order.
std::vector<std::string> conditionNames(const Truth& truth);

/// Whether the fabric on the tray is the rendered one, in trials that ask this.
TrialQuestion sameness(const SeenStudy& study, const Truth& truth);

/// Whether a trial stands behind the first block of its list, [trial of SeenStudy]. A repetition comes a block later, so that
/// none stands before: whoever knows the protocol knows this.
std::vector<bool> behindTheFirstBlock(const SeenStudy& study);

/// Whether a presentation is an anchor, and which kind, in the phases that have anchors. Trials of the first block are left out.
TrialQuestion anchors(const SeenStudy& study, const Truth& truth);

/// Trials of which the guesser knows the class: the fabric on the tray of a rating trial, or the truth of the other slots.
struct KnownTrials {
    std::vector<std::size_t> trials;
    std::vector<int> classes;
    int kinds = 0;
    int serves = -1;  ///< parity of the slots that it is used for; -1: all
};

/// The fabrics on the trays of the rating trials.
KnownTrials ratingsOf(const SeenStudy& study);

/// The truth about one half of the slots, for the other.
std::vector<KnownTrials> halvesOf(const SeenStudy& study, const TrialQuestion& question);

}  // namespace study::leaks
