// Compares stored answers with those of the same session without any fault, and makes copies of one study to harm.
#pragma once

#include <QTemporaryDir>
#include <filesystem>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "tests/support/study_builder.h"

namespace tests::promises {

/// Answers that are not as they were acknowledged.
struct Losses {
    int lost = 0;     ///< acknowledged and not stored
    int doubled = 0;  ///< stored more than once
    int wrong = 0;    ///< stored with another content, or never given
    int unsound = 0;  ///< studies with a fault that `verify` finds
    Losses& operator+=(const Losses& other);
    bool operator==(const Losses&) const = default;
};

/// "0 lost, 0 doubled, 0 altered, 0 unsound studies"
std::string textOf(const Losses& losses);

/// A study with one session to play, and what it stores without a fault. It is made once and copied.
class SessionStudy {
public:
    explicit SessionStudy(const support::StudyRecipe& recipe = {});

    const std::vector<std::string>& expected() const { return m_expected; }

    /// A new copy, in which nobody has answered.
    database::StudyFolder copy();

    /// Compares a store in which `acknowledged` answers were given, and at most one more was under way.
    Losses lossesIn(const database::StudyStore& store, int acknowledged) const;

private:
    QTemporaryDir m_place;
    database::StudyFolder m_original;
    std::vector<std::string> m_expected;
    int m_copies = 0;
};

/// The study of the paper with small images: 252 answers in a session.
support::StudyRecipe paperStudy();

}  // namespace tests::promises
