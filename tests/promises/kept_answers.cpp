#include "tests/promises/kept_answers.h"

#include <algorithm>
#include <set>

#include "protocols/protocol_json.h"
#include "tests/support/played_session.h"

namespace tests::promises {

namespace {

namespace fs = std::filesystem;

/// "TRIAL QUESTION" of a line.
std::string placeOf(const std::string& line) { return line.substr(0, line.find(' ', line.find(' ') + 1)); }

}  // namespace

Losses& Losses::operator+=(const Losses& other)
{
    lost += other.lost;
    doubled += other.doubled;
    wrong += other.wrong;
    unsound += other.unsound;
    return *this;
}

std::string textOf(const Losses& losses)
{
    return std::to_string(losses.lost) + " lost, " + std::to_string(losses.doubled) + " doubled, " +
           std::to_string(losses.wrong) + " altered, " + std::to_string(losses.unsound) + " unsound studies";
}

SessionStudy::SessionStudy(const support::StudyRecipe& recipe)
    : m_original(support::buildStudy(m_place.filePath("original").toStdString(), recipe))
{
    const database::StudyFolder undisturbed = copy();
    support::OpenSession session(undisturbed, "S01");
    session.playToEnd();
    m_expected = support::linesOf(session.store);
}

database::StudyFolder SessionStudy::copy()
{
    const fs::path folder = m_place.filePath(QString("copy%1").arg(++m_copies)).toStdString();
    fs::copy(m_original.folder, folder, fs::copy_options::recursive);
    for (const auto& sealed : fs::directory_iterator(m_original.stimuli()))
        fs::last_write_time(folder / "stimuli" / sealed.path().filename(), fs::last_write_time(sealed));
    return {folder};
}

Losses SessionStudy::lossesIn(const database::StudyStore& store, int acknowledged) const
{
    const std::vector<std::string> stored = support::linesOf(store);
    const auto known = std::min(static_cast<std::size_t>(acknowledged), m_expected.size());
    Losses losses;
    std::set<std::string> lines, places;
    for (const std::string& line : stored) {
        lines.insert(line);
        losses.doubled += !places.insert(placeOf(line)).second;
    }
    for (std::size_t answer = 0; answer < known; ++answer) losses.lost += !lines.contains(m_expected[answer]);
    const std::set<std::string> given(m_expected.begin(),
                                      m_expected.begin() + static_cast<long>(std::min(known + 1, m_expected.size())));
    losses.wrong = static_cast<int>(std::ranges::count_if(lines, [&](const std::string& line) { return !given.contains(line); }));
    losses.unsound = store.faults().empty() ? 0 : 1;
    return losses;
}

support::StudyRecipe paperStudy()
{
    support::StudyRecipe recipe;
    recipe.fabrics = 7;
    recipe.protocol = std::string(protocols::paperProtocolJson());
    return recipe;
}

}  // namespace tests::promises
