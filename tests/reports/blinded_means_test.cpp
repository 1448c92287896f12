// What a blinded report may say by condition, and what a sampler finds in it.
#include "reports/cells/blinded_means.h"

#include <QRegularExpression>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "protocols/random.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/tables/overview_tables.h"
#include "tests/reports/study_builder.h"

using namespace reports;

namespace {

/// Ratings of one participant of one fabric, in tenths, by trial and question, and the label of each trial.
struct Row {
    std::vector<std::vector<int>> ratings;
    std::vector<std::size_t> labels;
};

/// What an attacker knows of all rows, without `labels`, and the published means in tenths, by question and label.
struct Attacked {
    std::size_t questions = 0, labels = 0;
    std::vector<Row> rows;
    std::vector<std::vector<double>> means;
    double step = 0;  ///< tenths
};

/// Ratings that do not depend on the label. Mean 5 and standard deviation 2 on a scale of 0 to 10.
Attacked randomRatings(std::size_t rows, std::size_t labels, std::size_t questions, protocols::Random& random)
{
    Attacked known{questions, labels, {}, {}, 0};
    for (std::size_t r = 0; r < rows; ++r) {
        Row row;
        for (std::size_t i = 0; i < labels; ++i) {
            row.labels.push_back(i);
            row.ratings.emplace_back();
            for (std::size_t q = 0; q < questions; ++q) {
                int sum = 0;
                for (int die = 0; die < 4; ++die) sum += static_cast<int>(random.below(36));
                row.ratings.back().push_back(std::clamp(sum - 20, 0, 100));
            }
        }
        random.shuffle(row.labels);
        known.rows.push_back(std::move(row));
    }
    return known;
}

StudyData blindedStudy(const Attacked& known, int participants, int fabrics)
{
    std::vector<std::string> conditions;
    for (std::size_t k = 0; k < known.labels; ++k) conditions.push_back("K" + std::to_string(k + 1));
    std::vector<QuestionInfo> questions;
    for (std::size_t q = 0; q < known.questions; ++q) questions.push_back({"R" + std::to_string(q), "", builders::onScale});
    StudyData data = builders::emptyStudy(participants, fabrics, conditions, questions);
    data.blinded = true;
    for (std::size_t r = 0; r < known.rows.size(); ++r)
        for (std::size_t i = 0; i < known.labels; ++i)
            for (std::size_t q = 0; q < known.questions; ++q)
                data.responses.push_back(
                    builders::rated(data.participants[r / data.fabrics.size()], data.fabrics[r % data.fabrics.size()],
                                    conditions[known.rows[r].labels[i]], questions[q].id, known.rows[r].ratings[i][q] / 10.0));
    return data;
}

/// Walks through the assignments of labels that fit the published means, and counts the label that each trial has most often.
/// Swaps two labels of a row at a time; sums outside of what rounds to the mean cost their squared distance, at a temperature
/// that falls from 3000 to 1.
class Sampler {
public:
    Sampler(const Attacked& known, protocols::Random& random) : m_known(known), m_random(random)
    {
        const auto rows = static_cast<double>(known.rows.size());
        m_half = rows * known.step / 2;
        m_votes.assign(known.rows.size() * known.labels * known.labels, 0);
    }

    /// Share of trials whose label is named.
    double hits(int chains, int sweeps)
    {
        for (int chain = 0; chain < chains; ++chain) walk(sweeps);
        std::size_t right = 0;
        for (std::size_t r = 0; r < m_known.rows.size(); ++r)
            for (std::size_t i = 0; i < m_known.labels; ++i) {
                const auto votes = m_votes.begin() + static_cast<std::ptrdiff_t>((r * m_known.labels + i) * m_known.labels);
                const auto best = std::max_element(votes, votes + static_cast<std::ptrdiff_t>(m_known.labels)) - votes;
                right += static_cast<std::size_t>(best) == m_known.rows[r].labels[i];
            }
        return static_cast<double>(right) / static_cast<double>(m_known.rows.size() * m_known.labels);
    }

private:
    double cost(double distance) const
    {
        const double beyond = std::abs(distance) - m_half;
        return beyond > 0 ? beyond * beyond : 0;
    }

    void walk(int sweeps)
    {
        const std::size_t rows = m_known.rows.size(), labels = m_known.labels, questions = m_known.questions;
        std::vector<std::vector<std::size_t>> now(rows, std::vector<std::size_t>(labels));
        std::vector<std::vector<double>> off = m_known.means;
        for (auto& question : off)
            for (double& mean : question) mean *= -static_cast<double>(rows);
        for (std::size_t r = 0; r < rows; ++r) {
            std::iota(now[r].begin(), now[r].end(), std::size_t{0});
            m_random.shuffle(now[r]);
            for (std::size_t i = 0; i < labels; ++i)
                for (std::size_t q = 0; q < questions; ++q) off[q][now[r][i]] += m_known.rows[r].ratings[i][q];
        }
        const std::size_t steps = rows * labels * static_cast<std::size_t>(sweeps);
        double temperature = 3000;
        for (std::size_t step = 0; step < 2 * steps; ++step) {
            if (step < steps) temperature = 3000 * std::pow(1.0 / 3000, static_cast<double>(step) / static_cast<double>(steps));
            const std::size_t r = m_random.below(rows), i = m_random.below(labels), j = m_random.below(labels);
            if (i != j) swapIfFitting(m_known.rows[r], now[r], off, i, j, temperature);
            if (step >= steps && step % (rows * labels) == 0) vote(now);
        }
    }

    void swapIfFitting(const Row& row, std::vector<std::size_t>& now, std::vector<std::vector<double>>& off, std::size_t i,
                       std::size_t j, double temperature)
    {
        const std::size_t a = now[i], b = now[j];
        double change = 0;
        for (std::size_t q = 0; q < m_known.questions; ++q) {
            const double d = row.ratings[i][q] - row.ratings[j][q];
            change += cost(off[q][a] - d) - cost(off[q][a]) + cost(off[q][b] + d) - cost(off[q][b]);
        }
        if (change > 0 && static_cast<double>(m_random.below(1U << 30)) / (1U << 30) >= std::exp(-change / temperature)) return;
        std::swap(now[i], now[j]);
        for (std::size_t q = 0; q < m_known.questions; ++q) {
            const double d = row.ratings[i][q] - row.ratings[j][q];
            off[q][a] -= d;
            off[q][b] += d;
        }
    }

    void vote(const std::vector<std::vector<std::size_t>>& now)
    {
        for (std::size_t r = 0; r < now.size(); ++r)
            for (std::size_t i = 0; i < m_known.labels; ++i) ++m_votes[(r * m_known.labels + i) * m_known.labels + now[r][i]];
    }

    const Attacked& m_known;
    protocols::Random& m_random;
    double m_half = 0;
    std::vector<int> m_votes;
};

std::set<std::string> flagNames(const StudyAnalysis& analysis)
{
    std::set<std::string> names;
    for (const QualityFlag& flag : analysis.flags) names.insert(nameOf(flag.kind));
    return names;
}

}  // namespace

class BlindedMeansTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void stepsTellLittleOfWhichTrialHasWhichLabel_data()
    {
        QTest::addColumn<double>("width");
        QTest::addColumn<int>("answers");
        QTest::addColumn<int>("labels");
        QTest::addColumn<int>("questions");
        QTest::addColumn<double>("step");
        QTest::newRow("the paper's ratings") << 10.0 << 70 << 9 << 4 << 1.0;
        QTest::newRow("on a scale to 100") << 100.0 << 70 << 9 << 4 << 10.0;
        QTest::newRow("the paper's choices") << 1.0 << 70 << 9 << 4 << 0.1;
        QTest::newRow("as few as there may be") << 10.0 << 40 << 5 << 3 << 2.0;
        QTest::newRow("24 people") << 10.0 << 168 << 9 << 4 << 1.0;
        QTest::newRow("many answers") << 10.0 << 8000 << 2 << 1 << 0.1;
        // 30 numbers against 60 bits: a tenth of a bit each.
        QTest::newRow("many questions") << 10.0 << 60 << 2 << 30 << 2.0;
        QTest::newRow("few questions") << 10.0 << 60 << 2 << 3 << 1.0;
        QTest::newRow("one label hides nothing") << 10.0 << 40 << 1 << 3 << 2.0;
    }

    void stepsTellLittleOfWhichTrialHasWhichLabel()
    {
        QFETCH(double, width);
        QFETCH(int, answers);
        QFETCH(int, labels);
        QFETCH(int, questions);
        QFETCH(double, step);
        QCOMPARE(meansStep(width, {static_cast<std::size_t>(answers), static_cast<std::size_t>(labels),
                                   static_cast<std::size_t>(questions)}),
                 step);
    }

    void meansAreWholeStepsFromTheMeanOfAll()
    {
        StudyData data = builders::paperSized();
        const auto open = resultsJson(analyse(data), {})["questions"];
        data.blinded = true;
        const auto blinded = resultsJson(analyse(data), {})["questions"];
        double sum = 0;
        std::size_t n = 0;
        for (const StudyResponse& response : data.responses)
            if (response.question == "Q3") {
                sum += std::get<RatedAnswer>(response.content).rating;
                ++n;
            }
        const double centre = std::round(10 * sum / static_cast<double>(n)) / 10;
        std::set<double> shown;
        for (const std::string& condition : data.conditions) {
            const double share = open["Q1"][condition]["proportion"], mean = open["Q3"][condition]["mean"];
            QCOMPARE(blinded["Q1"][condition]["proportion"].get<double>(), std::round(share * 10) / 10);
            QCOMPARE(blinded["Q1"][condition]["rounded_to"].get<double>(), 0.1);
            QCOMPARE(blinded["Q3"][condition]["mean"].get<double>(), centre + std::round(mean - centre));
            QCOMPARE(blinded["Q3"][condition]["rounded_to"].get<double>(), 1.0);
            QCOMPARE(blinded["Q3"][condition]["n"], 70);
            shown.insert(blinded["Q3"][condition]["mean"].get<double>());
        }
        QVERIFY(shown.size() > 1);  // a difference of more than a step shows
    }

    /// Every presentation asks for words once: their number under a label is that of the ratings beside them.
    void answersInWordsAreCountedUnderEachLabel()
    {
        StudyData data = builders::paperSized();
        data.blinded = true;
        data.questions.push_back({"Why", "Why?", protocols::FreeText{}});
        const std::vector<StudyResponse> ratings = data.responses;
        for (const StudyResponse& one : ratings)
            if (one.question == "Q2")
                data.responses.push_back(builders::worded(one.participant, one.fabric, one.condition, "Why", "soft"));
        const StudyAnalysis analysis = analyse(data);
        const auto questions = resultsJson(analysis, {})["questions"];
        for (const std::string& condition : data.conditions) {
            QCOMPARE(questions["Why"][condition]["answers"], 70);
            QCOMPARE(questions["Q2"][condition]["n"], 70);
        }
        for (const BlindedMean& one : analysis.blindedMeans.questions.back().conditions) {
            QCOMPARE(one.n, std::size_t{70});
            QVERIFY(!one.mean.exists());
        }
        QVERIFY(!QRegularExpression("(^|\\s)0(\\s|$)").match(QString::fromStdString(overviewText(analysis))).hasMatch());
        StudyData open = data;
        open.blinded = false;
        QCOMPARE(resultsJson(analyse(open), {})["questions"]["Why"]["f"]["answers"], 70);
    }

    void meansWaitForEveryPlaceAndFortyAnswers()
    {
        StudyData data = builders::paperSized();
        data.blinded = true;
        QCOMPARE(blindedMeans(data).why, std::string());
        data.finished.erase("P03");
        data.openPlaces = 1;
        QCOMPARE(
            blindedMeans(data).why,
            std::string(
                "There are no means under K-labels yet: 1 place of the study is not finished. Means before and after "
                "one participant would name the labels of that participant. Who withdraws after the end leaves a place open."));
        QVERIFY(blindedMeans(data).questions.empty());
        data.finished = {"P05", "P06"};
        QVERIFY(blindedMeans(data).why.find("2 participants have finished, and at least 3 are needed.") != std::string::npos);

        const auto sized = [](int participants, int fabrics) {
            StudyData built =
                builders::study(participants, fabrics, {"f", "h"},
                                {[](int p, int, int) { return p % 2 == 0; }, [](int, int, int, int) { return 4.0; }});
            built.blinded = true;
            return blindedMeans(built).why;
        };
        QCOMPARE(sized(13, 3),
                 std::string("There are no means under K-labels: a label has fewer than 40 answers to each question."));
        QCOMPARE(sized(10, 4), std::string());
    }

    /// The same sampler with means of three people that are rounded to 0.1, as reports once were.
    void aSamplerNamesTheTrialsOfThreePeople()
    {
        protocols::Random random(1);
        Attacked known = randomRatings(3, 4, 3, random);
        known.step = 1;
        known.means.assign(3, std::vector<double>(4));
        for (const Row& row : known.rows)
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t q = 0; q < 3; ++q) known.means[q][row.labels[i]] += row.ratings[i][q] / 3.0;
        for (auto& question : known.means)
            for (double& mean : question) mean = std::round(mean);
        QCOMPARE(Sampler(known, random).hits(4, 4000), 1.0);
    }

    void aSamplerStaysNearChanceInAWholeStudy_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<int>("fabrics");
        QTest::addColumn<int>("labels");
        QTest::newRow("8 people, 5 fabrics, 5 labels") << 8 << 5 << 5;
        QTest::newRow("12 people, 4 fabrics, 3 labels") << 12 << 4 << 3;
        QTest::newRow("12 people, 10 fabrics, 2 labels") << 12 << 10 << 2;
        QTest::newRow("10 people, 7 fabrics, 9 labels") << 10 << 7 << 9;
    }

    void aSamplerStaysNearChanceInAWholeStudy()
    {
        QFETCH(int, participants);
        QFETCH(int, fabrics);
        QFETCH(int, labels);
        double hits = 0;
        constexpr int studies = 4;
        for (int study = 0; study < studies; ++study) {
            protocols::Random random(static_cast<std::uint64_t>(study) + 2);
            Attacked known =
                randomRatings(static_cast<std::size_t>(participants * fabrics), static_cast<std::size_t>(labels), 3, random);
            const BlindedMeans published = blindedMeans(blindedStudy(known, participants, fabrics));
            QCOMPARE(published.why, std::string());
            for (const BlindedQuestion& question : published.questions) {
                known.means.emplace_back();
                known.step = 10 * question.step;
                for (const BlindedMean& mean : question.conditions) known.means.back().push_back(10 * *mean.mean);
            }
            hits += Sampler(known, random).hits(2, 400) / studies;
        }
        const double chance = 1.0 / labels;
        std::printf("%s: %.1f %% of the labels named (chance %.1f %%)\n", QTest::currentDataTag(), 100 * hits, 100 * chance);
        QVERIFY2(hits < 1.15 * chance, QTest::currentDataTag());
    }

    /// With the key, equal ratings of the listed trials and high ones of blank glass would be flagged, and so name both.
    void flagsAndCountsNeedNoKey()
    {
        StudyData data = builders::emptyStudy(1, 20, {"K1"}, {{"Q2", "", builders::onScale}});
        data.questions.front().presentations = 42;
        for (const std::string& fabric : data.fabrics) data.responses.push_back(builders::rated("P01", fabric, "K1", "Q2", 0));
        for (int glass = 0; glass < 21; ++glass) {
            data.catchResponses.push_back(builders::rated("P01", "F01", "", "Q2", 5 + 0.1 * glass));
            data.catchResponses.back().repetition = std::to_string(glass);
        }
        QCOMPARE(flagNames(analyse(data)), (std::set<std::string>{"blank_glass_rated_high", "straight_lining"}));
        data.blinded = true;
        const StudyAnalysis blinded = analyse(data);
        QCOMPARE(flagNames(blinded), std::set<std::string>{"missing_answers"});
        QCOMPARE(blinded.flags.front().why, std::string("answers missing: Q2: 1 of 42"));
        const auto counts = statisticsJson(blinded)["data"];
        QCOMPARE(counts["responses"], 41);
        QCOMPARE(counts["expected_responses"], 42);
    }
};

QTEST_GUILESS_MAIN(BlindedMeansTest)
#include "blinded_means_test.moc"
