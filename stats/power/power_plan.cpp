#include "stats/power/power_plan.h"

#include <cstdio>

#include "stats/power/power.h"
#include "stats/power/power_groups.h"

namespace stats {
namespace {

constexpr double wantedPower = 0.8;

Value participantsFor(const GroupedTest& test, StudyDesign design, double effect, const std::string& question)
{
    if (question == "signals") return Value::undefined("the fabrics are the unit");
    if (const Value here = test.formula(design, effect); !here.exists()) return here;
    return participantsNeeded(
        [&](double n) {
            design.participants = static_cast<std::size_t>(n);
            return *test.formula(design, effect);
        },
        1000, wantedPower);
}

Value detectableBy(const GroupedTest& test, const StudyDesign& design)
{
    if (const Value here = test.formula(design, test.most); !here.exists()) return here;
    return smallestDetectable([&](double effect) { return *test.formula(design, effect); }, test.most, wantedPower);
}

PlannedTest plannedTest(const PowerGroup& group, const GroupedTest& test, const PowerOptions& options)
{
    if (test.most == 0)
        return {
            group.question, test.name, group.effect, narrowestBounds(options), "bounds about no difference, scale points", {}};
    return {group.question, test.name, group.effect, detectableBy(test, options.design), group.effect, {}};
}

/// Name of the studies with this effect.
std::string studiesOf(const PowerGroup& group, double effect)
{
    char number[32];
    std::snprintf(number, sizeof number, "%.17g", effect);
    return group.question + ", " + group.effect + " of " + number;
}

std::vector<Rejections> simulatedRejections(const PowerGroup& group, double effect, const PowerOptions& options)
{
    const std::string studies = studiesOf(group, effect);
    if (options.counted)
        if (std::vector<Rejections> counts = options.counted(studies, options.simulation.ownStudies());
            counts.size() == group.tests.size()) {
            if (options.simulation.done) options.simulation.done(options.simulation.ownStudies());
            return counts;
        }
    const SimulatedAnalysis analysis = [&](Draws& draws, std::span<Value> p) { group.analysis(effect, draws, p); };
    std::vector<Rejections> counts = simulateTests(group.tests.size(), analysis, options.simulation);
    if (options.finished) options.finished(studies, counts);
    return counts;
}

void addTests(std::vector<PlannedTest>& planned, const PowerGroup& group, const PowerOptions& options)
{
    std::vector<PlannedTest> tests;
    for (const GroupedTest& test : group.tests) tests.push_back(plannedTest(group, test, options));
    for (const double effect : group.effects) {
        const auto simulated = simulatedRejections(group, effect, options);
        for (std::size_t t = 0; t < tests.size(); ++t)
            tests[t].points.push_back({effect, group.tests[t].formula(options.design, effect), simulated[t],
                                       participantsFor(group.tests[t], options.design, effect, group.question)});
    }
    planned.insert(planned.end(), tests.begin(), tests.end());
}

}  // namespace

Value narrowestBounds(const PowerOptions& options)
{
    const auto n = static_cast<double>(options.design.participants);
    const double sd = ofTheseFabrics(options.ratings).sdOfDifference(options.design);
    const auto power = [&](double bound) { return bound > 0 ? equivalencePower({n, sd, -bound, bound, 0.05}, 0) : 0.0; };
    return smallestDetectable(power, options.ratings.scaleMax - options.ratings.scaleMin, wantedPower);
}

std::vector<PlannedTest> plannedTests(const PowerOptions& options)
{
    std::vector<PlannedTest> planned;
    for (const PowerGroup& group : powerGroups(options)) addTests(planned, group, options);
    return planned;
}

std::size_t plannedStudies(const PowerOptions& options)
{
    std::size_t studies = 0;
    for (const PowerGroup& group : powerGroups(options)) studies += group.effects.size() * options.simulation.ownStudies();
    return studies;
}

}  // namespace stats
