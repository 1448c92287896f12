#include "study/leaks/questions.h"

#include <algorithm>
#include <iterator>
#include <set>

namespace study::leaks {

namespace {

/// Trials with one of the same classes each. The chance is the share of the commonest.
TrialQuestion classesOf(const std::string& target, const std::vector<std::size_t>& trials, const std::vector<std::string>& truth)
{
    const std::set<std::string> names(truth.begin(), truth.end());
    std::vector<int> classes;
    std::ptrdiff_t commonest = 0;
    for (const auto& name : names) {
        classes.push_back(static_cast<int>(classes.size()));
        commonest = std::max(commonest, std::ranges::count(truth, name));
    }
    const double chance = truth.empty() ? 1 : static_cast<double>(commonest) / static_cast<double>(truth.size());
    TrialQuestion question{target, trials, {}, {}, std::vector<double>(trials.size(), chance), static_cast<int>(classes.size())};
    for (const auto& own : truth) {
        question.classes.push_back(classes);
        question.truth.push_back(static_cast<std::size_t>(std::distance(names.begin(), names.find(own))));
    }
    return question;
}

}  // namespace

TrialQuestion pieces(const SeenStudy& study, const Truth& truth)
{
    TrialQuestion question{"true piece", {}, {}, {}, {}, static_cast<int>(study.fabrics.size())};
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        const auto& tray = study.trials[i].tray;
        const auto at = std::ranges::find(tray, truth.trials[i].fabric);
        if (!study.isChoice(study.trials[i]) || at == tray.end()) continue;
        question.trials.push_back(i);
        auto& classes = question.classes.emplace_back();
        for (const auto& fabric : tray)
            classes.push_back(static_cast<int>(std::ranges::find(study.fabrics, fabric) - study.fabrics.begin()));
        question.truth.push_back(static_cast<std::size_t>(at - tray.begin()));
        question.chance.push_back(1.0 / static_cast<double>(tray.size()));
    }
    return question;
}

TrialQuestion places(TrialQuestion question)
{
    question.kinds = 0;
    for (auto& classes : question.classes) {
        for (std::size_t place = 0; place < classes.size(); ++place) classes[place] = static_cast<int>(place);
        question.kinds = std::max(question.kinds, static_cast<int>(classes.size()));
    }
    return question;
}

std::vector<std::string> conditionNames(const Truth& truth)
{
    std::set<std::string> names;
    for (const auto& shown : truth.trials) names.insert(shown.condition);
    return {names.begin(), names.end()};
}

TrialQuestion conditions(const SeenStudy& study, const Truth& truth)
{
    std::vector<std::size_t> trials;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        trials.push_back(i);
        names.push_back(truth.trials[i].condition);
    }
    return classesOf("condition", trials, names);
}

TrialQuestion sameness(const SeenStudy& study, const Truth& truth)
{
    std::vector<std::size_t> trials;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        const auto& trial = study.trials[i];
        if (study.isChoice(trial) || study.showsTruth(trial)) continue;
        trials.push_back(i);
        names.push_back(trial.tray.front() == truth.trials[i].fabric ? "same" : "different");
    }
    return classesOf("same or different", trials, names);
}

std::vector<bool> behindTheFirstBlock(const SeenStudy& study)
{
    const auto block = static_cast<std::size_t>(std::max(0, study.protocol.breakAfterPresentations));
    std::vector<bool> behind;
    for (std::size_t begin = 0, end = 0; begin < study.trials.size(); begin = end) {
        while (end < study.trials.size() && study.trials[end].isInListOf(study.trials[begin])) ++end;
        for (std::size_t at = begin; at < end; ++at) behind.push_back(at - begin >= std::min(block + 1, (end - begin) / 2));
    }
    return behind;
}

TrialQuestion anchors(const SeenStudy& study, const Truth& truth)
{
    const auto behind = behindTheFirstBlock(study);
    std::vector<std::size_t> trials;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < study.trials.size(); ++i) {
        const auto& phase = study.protocol.phases.at(static_cast<std::size_t>(study.trials[i].phase));
        if (phase.anchors.presentations() == 0 || !behind[i]) continue;
        trials.push_back(i);
        names.push_back(truth.trials[i].anchor);
    }
    return classesOf("anchor", trials, names);
}

KnownTrials ratingsOf(const SeenStudy& study)
{
    KnownTrials known;
    known.kinds = static_cast<int>(study.fabrics.size());
    for (std::size_t i = 0; i < study.trials.size(); ++i)
        if (study.showsTruth(study.trials[i])) {
            known.trials.push_back(i);
            const auto fabric = std::ranges::find(study.fabrics, study.trials[i].tray.front()) - study.fabrics.begin();
            known.classes.push_back(static_cast<int>(fabric));
        }
    return known;
}

std::vector<KnownTrials> halvesOf(const SeenStudy& study, const TrialQuestion& question)
{
    std::vector<KnownTrials> halves;
    for (const int serves : {0, 1}) {
        KnownTrials& known = halves.emplace_back();
        known.kinds = question.kinds;
        known.serves = serves;
        for (std::size_t item = 0; item < question.trials.size(); ++item)
            if (study.trials[question.trials[item]].slot % 2 != serves) {
                known.trials.push_back(question.trials[item]);
                known.classes.push_back(question.classes[item][question.truth[item]]);
            }
    }
    return halves;
}

}  // namespace study::leaks
