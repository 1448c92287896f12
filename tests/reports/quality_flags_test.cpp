// Every flag on both sides of its limit.
#include "reports/analysis/quality_flags.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/reports/study_builder.h"

using namespace reports;

namespace {

const std::vector<std::string> oneCondition{"f"};

/// Participant P01 gives these ratings to Q2, one a fabric.
StudyData ratingsOf(const std::vector<double>& ratings)
{
    StudyData data = builders::emptyStudy(1, static_cast<int>(ratings.size()), oneCondition, {{"Q2", "", builders::onScale}});
    for (std::size_t i = 0; i < ratings.size(); ++i)
        data.responses.push_back(builders::rated("P01", data.fabrics[i], "f", "Q2", ratings[i]));
    return data;
}

/// `favourite` of `trials` choices are of slot B, the others of A and C in turn.
StudyData slotsOf(int favourite, int trials, const protocols::AnswerKind& kind)
{
    StudyData data = builders::emptyStudy(1, trials, oneCondition, {{"Q1", "", kind}});
    for (int i = 0; i < trials; ++i) {
        const int slot = i < favourite ? 1 : (i % 2) * 2;
        data.responses.push_back(
            {"P01", data.fabrics[static_cast<std::size_t>(i)], "f", "Q1", ChosenAnswer{true, std::nullopt, slot}, {}});
    }
    return data;
}

/// "flag: why" of every flag.
QStringList flagged(const StudyData& data)
{
    QStringList lines;
    for (const QualityFlag& flag : qualityFlags(data))
        lines << QString::fromStdString(flag.participant.value_or("all") + " " + nameOf(flag.kind) + ": " + flag.why);
    return lines;
}

/// 1, 2, 3 ... : no two equal.
std::vector<double> different(std::size_t n)
{
    std::vector<double> ratings(n);
    for (std::size_t i = 0; i < n; ++i) ratings[i] = 0.1 * static_cast<double>(i + 1);
    return ratings;
}

protocols::AnswerKind scaleOfSteps(int steps)
{
    protocols::Rating rating;
    rating.scale.min = rating.scale.step = protocols::Tenths{10};
    rating.scale.max = protocols::Tenths{10 * steps};
    return rating;
}

/// P01 gives `equal` of 20 ratings as 1, the others in turn; P02 gives the numbers 1 to `steps` in turn.
StudyData onShortScale(int steps, int equal)
{
    StudyData data = builders::emptyStudy(2, 20, oneCondition, {{"Q2", "", scaleOfSteps(steps)}});
    for (int i = 0; i < 20; ++i) {
        const std::string& fabric = data.fabrics[static_cast<std::size_t>(i)];
        data.responses.push_back(builders::rated("P01", fabric, "f", "Q2", i < equal ? 1 : 2 + i % (steps - 1)));
        data.responses.push_back(builders::rated("P02", fabric, "f", "Q2", 1 + i % steps));
    }
    return data;
}

/// P01 gives ratings of 60 to 71 on a line from 0 to 100 (Q2), and of 4 to 6 on a scale from 1 to 7 (Q3).
StudyData onTwoScales()
{
    protocols::Rating line, words;
    line.scale.max = protocols::Tenths{1000};
    words.scale.min = protocols::Tenths{10};
    words.scale.max = protocols::Tenths{70};
    StudyData data = builders::emptyStudy(1, 12, oneCondition, {{"Q2", "", line}, {"Q3", "", words}});
    for (std::size_t i = 0; i < data.fabrics.size(); ++i) {
        data.responses.push_back(builders::rated("P01", data.fabrics[i], "f", "Q2", 60.0 + static_cast<double>(i)));
        data.responses.push_back(builders::rated("P01", data.fabrics[i], "f", "Q3", 4.0 + static_cast<double>(i % 3)));
    }
    return data;
}

}  // namespace

class QualityFlagsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void missingAnswersAreCountedByQuestion()
    {
        StudyData data = ratingsOf(different(12));
        QCOMPARE(flagged(data), QStringList());
        data.responses.pop_back();
        data.questions.push_back({"Why", "", protocols::FreeText{}});
        data.responses.push_back(builders::worded("P01", "F01", "f", "Why", "soft"));
        QCOMPARE(flagged(data), (QStringList{"P01 missing_answers: answers missing: Q2: 1 of 12, Why: 11 of 12"}));
    }

    // More than 5 % of the answers below 0.5 s: 1 of 20 is not more, 2 of 20 are.
    void fastAnswers_data()
    {
        QTest::addColumn<int>("answers");
        QTest::addColumn<int>("fast");
        QTest::addColumn<double>("seconds");
        QTest::addColumn<QStringList>("flags");
        const QString tail = ") came within 0.5 s of the touch";
        QTest::newRow("5 %") << 20 << 1 << 0.4 << QStringList();
        QTest::newRow("10 %") << 20 << 2 << 0.4 << QStringList{"P01 too_fast: 2 of 20 answers (10 %" + tail};
        QTest::newRow("5.3 %") << 19 << 1 << 0.4 << QStringList{"P01 too_fast: 1 of 19 answers (5 %" + tail};
        QTest::newRow("at the limit") << 20 << 20 << 0.5 << QStringList();
        QTest::newRow("just below") << 20 << 20 << 0.4999 << QStringList{"P01 too_fast: 20 of 20 answers (100 %" + tail};
        QTest::newRow("ten answers") << 10 << 10 << 0.1 << QStringList{"P01 too_fast: 10 of 10 answers (100 %" + tail};
        QTest::newRow("nine answers") << 9 << 9 << 0.1 << QStringList();
    }
    void fastAnswers()
    {
        QFETCH(int, answers);
        QFETCH(int, fast);
        QFETCH(double, seconds);
        QFETCH(QStringList, flags);
        StudyData data = ratingsOf(different(static_cast<std::size_t>(answers)));
        for (int i = 0; i < answers; ++i) data.responses[static_cast<std::size_t>(i)].seconds = i < fast ? seconds : 5;
        QCOMPARE(flagged(data), flags);
    }

    void wordsMayBeQuick()
    {
        StudyData data = ratingsOf(different(12));
        data.questions.push_back({"Why", "", protocols::FreeText{}});
        for (const std::string& fabric : data.fabrics) {
            data.responses.push_back(builders::worded("P01", fabric, "f", "Why", "soft"));
            data.responses.back().seconds = 0.1;
        }
        QCOMPARE(flagged(data), QStringList());
    }

    // At least half of the ratings are one number, of at least ten ratings.
    void equalRatings_data()
    {
        QTest::addColumn<int>("equal");
        QTest::addColumn<int>("ratings");
        QTest::addColumn<QStringList>("flags");
        QTest::newRow("half") << 6 << 12 << QStringList{"P01 straight_lining: Q2: 6 of 12 ratings are 9.5"};
        QTest::newRow("less than half") << 6 << 13 << QStringList();
        QTest::newRow("ten") << 5 << 10 << QStringList{"P01 straight_lining: Q2: 5 of 10 ratings are 9.5"};
        QTest::newRow("nine") << 9 << 9 << QStringList();
    }
    void equalRatings()
    {
        QFETCH(int, equal);
        QFETCH(int, ratings);
        QFETCH(QStringList, flags);
        std::vector<double> values = different(static_cast<std::size_t>(ratings));
        std::fill_n(values.begin(), equal, 9.5);
        QCOMPARE(flagged(ratingsOf(values)), flags);
    }

    // On short scales 3 divided by the number of steps, which the protocol states or the answers show.
    void equalRatingsOnShortScales_data()
    {
        QTest::addColumn<int>("steps");
        QTest::addColumn<int>("equal");
        QTest::addColumn<bool>("isFlagged");
        QTest::newRow("2 steps, all") << 2 << 20 << false;
        QTest::newRow("3 steps, all but one") << 3 << 19 << false;
        QTest::newRow("3 steps, all") << 3 << 20 << true;
        QTest::newRow("4 steps, below 75 %") << 4 << 14 << false;
        QTest::newRow("4 steps, 75 %") << 4 << 15 << true;
        QTest::newRow("5 steps, below 60 %") << 5 << 11 << false;
        QTest::newRow("5 steps, 60 %") << 5 << 12 << true;
        QTest::newRow("6 steps, below 50 %") << 6 << 9 << false;
        QTest::newRow("6 steps, 50 %") << 6 << 10 << true;
    }
    void equalRatingsOnShortScales()
    {
        QFETCH(int, steps);
        QFETCH(int, equal);
        QFETCH(bool, isFlagged);
        StudyData data = onShortScale(steps, equal);
        const QStringList flags =
            isFlagged ? QStringList{QString("P01 straight_lining: Q2: %1 of 20 ratings are 1").arg(equal)} : QStringList();
        QCOMPARE(flagged(data), flags);
        data.plannedDesign.emplace().questions = {"Q2"};
        QCOMPARE(flagged(data), flags);
    }

    /// The protocol has more numbers than the few that were given.
    void theScaleOfTheProtocolCounts()
    {
        StudyData data = ratingsOf({1, 1, 1, 1, 1, 9, 9, 9, 9, 9});
        QCOMPARE(flagged(data), QStringList());
        data.plannedDesign.emplace().questions = {"Q2"};
        QCOMPARE(flagged(data), QStringList{"P01 straight_lining: Q2: 5 of 10 ratings are 1"});
    }

    /// People rate around the middle of a short scale with an SD of a fifth of it. Half of 21 such ratings are one number in 81,
    /// 32, 14 and 2 % of them.
    void honestRatersAreSeldomFlagged()
    {
        constexpr int people = 500, fabrics = 21;
        for (const int steps : {3, 4, 5, 7}) {
            std::mt19937 bits(static_cast<unsigned>(steps));
            std::normal_distribution<double> normal((steps + 1) / 2.0, 0.2 * steps);
            StudyData data = builders::emptyStudy(people, fabrics, oneCondition, {{"Q2", "", scaleOfSteps(steps)}});
            for (const std::string& participant : data.participants)
                for (const std::string& fabric : data.fabrics)
                    data.responses.push_back(builders::rated(participant, fabric, "f", "Q2",
                                                             std::clamp(std::round(normal(bits)), 1.0, double(steps))));
            const auto flags = flagged(data).size();
            QVERIFY2(flags < 0.05 * people, qPrintable(QString("%1 steps: %2 flagged").arg(steps).arg(flags)));
        }
    }

    // One number for all questions in at least 80 % of at least ten presentations.
    void equalAcrossQuestions_data()
    {
        QTest::addColumn<int>("same");
        QTest::addColumn<int>("presentations");
        QTest::addColumn<QStringList>("flags");
        const QString tail = " presentations got the same number for every question";
        QTest::newRow("80 %") << 8 << 10 << QStringList{"P01 same_across_questions: 8 of 10" + tail};
        QTest::newRow("less") << 8 << 11 << QStringList();
        QTest::newRow("nine presentations") << 9 << 9 << QStringList();
    }
    void equalAcrossQuestions()
    {
        QFETCH(int, same);
        QFETCH(int, presentations);
        QFETCH(QStringList, flags);
        StudyData data = ratingsOf(different(static_cast<std::size_t>(presentations)));
        data.questions.push_back({"Q3", "", builders::onScale});
        for (int i = 0; i < presentations; ++i) {
            StudyResponse other = data.responses[static_cast<std::size_t>(i)];
            other.question = "Q3";
            if (i >= same) std::get<RatedAnswer>(other.content).rating += 3;
            data.responses.push_back(other);
        }
        QCOMPARE(flagged(data), flags);
    }

    /// Each repetition of a cell is a presentation of its own.
    void repetitionsAreComparedAcrossQuestionsOneByOne()
    {
        StudyData data = builders::emptyStudy(1, 5, oneCondition, {{"Q2", "", builders::onScale}, {"Q3", "", builders::onScale}});
        data.answersPerCell = 2;
        for (int i = 0; i < 10; ++i)
            for (const char* question : {"Q2", "Q3"}) {
                data.responses.push_back(
                    builders::rated("P01", data.fabrics[static_cast<std::size_t>(i / 2)], "f", question, 0.5 * i));
                data.responses.back().repetition = i % 2 == 0 ? "first" : "second";
            }
        const QStringList whole{"P01 same_across_questions: 10 of 10 presentations got the same number for every question"};
        QCOMPARE(flagged(data), whole);
        for (StudyResponse& response : data.responses)
            if (response.question == "Q3" && response.repetition == "second")
                std::get<RatedAnswer>(response.content).rating += 0.1;
        QCOMPARE(flagged(data), QStringList());
    }

    void oneRatingQuestionCannotBeEqualAcrossQuestions() { QCOMPARE(flagged(ratingsOf(different(12))), QStringList()); }

    // scipy 1.10.1: from scipy.stats import binomtest; 3 * binomtest(k, 20, 1/3, 'greater').pvalue
    // k = 12: 0.0391, k = 13: 0.0111, k = 14: 0.00264; the limit is 0.01.
    // 2 * binomtest(k, 20, 1/2, 'greater').pvalue: k = 15: 0.0414, k = 16: 0.0118, k = 17: 0.00258.
    void favouriteSlot_data()
    {
        QTest::addColumn<int>("favourite");
        QTest::addColumn<int>("alternatives");
        QTest::addColumn<QStringList>("flags");
        const QString head = "P01 slot_bias: Q1: tray slot B was chosen in ";
        QTest::newRow("13 of 20 among 3") << 13 << 3 << QStringList();
        QTest::newRow("14 of 20 among 3") << 14 << 3 << QStringList{head + "14 of 20 trials (p = .003)"};
        QTest::newRow("20 of 20 among 3") << 20 << 3 << QStringList{head + "20 of 20 trials (p < .001)"};
        QTest::newRow("16 of 20 among 2") << 16 << 2 << QStringList();
        QTest::newRow("17 of 20 among 2") << 17 << 2 << QStringList{head + "17 of 20 trials (p = .003)"};
    }
    void favouriteSlot()
    {
        QFETCH(int, favourite);
        QFETCH(int, alternatives);
        QFETCH(QStringList, flags);
        QCOMPARE(flagged(slotsOf(favourite, 20, protocols::ForcedChoice{alternatives})), flags);
    }

    void favouriteWordOfSameAndDifferentIsNamed()
    {
        StudyData data = slotsOf(20, 20, protocols::SameDifferent{});
        for (StudyResponse& response : data.responses) std::get<ChosenAnswer>(response.content).answer = "different";
        QCOMPARE(flagged(data), (QStringList{"P01 slot_bias: Q1: the answer \"different\" was given in all 20 trials"}));
    }

    void aTendencyToSaySameIsNoFault()
    {
        StudyData data = slotsOf(19, 20, protocols::SameDifferent{});
        for (StudyResponse& response : data.responses) std::get<ChosenAnswer>(response.content).answer = "same";
        QCOMPARE(flagged(data), QStringList());
    }

    void slotsOfNineTrialsAreNotJudged() { QCOMPARE(flagged(slotsOf(9, 9, protocols::ForcedChoice{3})), QStringList()); }

    // Mean of the renderings: 0.65.
    void blankGlass_data()
    {
        QTest::addColumn<QList<double>>("blank");
        QTest::addColumn<QStringList>("flags");
        const QString why = " ratings of blank glass (catch trials) have at least the mean of the renderings' ratings";
        QTest::newRow("equal mean") << QList<double>{0.6, 0.65, 0.7} << QStringList{"P01 blank_glass_rated_high: 3" + why};
        QTest::newRow("below") << QList<double>{0.6, 0.64, 0.7} << QStringList();
        QTest::newRow("two ratings") << QList<double>{9, 9} << QStringList();
    }
    void blankGlass()
    {
        QFETCH(QList<double>, blank);
        QFETCH(QStringList, flags);
        StudyData data = ratingsOf(different(12));
        for (const double rating : blank) data.catchResponses.push_back(builders::rated("P01", "F01", "f", "Q2", rating));
        data.catchResponses.push_back(builders::rated("P02", "F01", "f", "Q2", 9));
        QCOMPARE(flagged(data), flags);
    }

    // The means are 65.5 on the line and 5 in words. 40 of 100 is low although it is above the mean of all ratings (35.25), and 6
    // of 7 is high although it is below. Over both questions the differences are shares of the scales: -25.5 of 100 and 1 of 6.
    void ratingsAreComparedWithinTheirQuestion_data()
    {
        QTest::addColumn<QList<double>>("line");   // of blank glass to Q2
        QTest::addColumn<QList<double>>("words");  // of blank glass to Q3
        QTest::addColumn<bool>("isFlagged");
        QTest::newRow("low on the line") << QList<double>{40, 40, 40} << QList<double>{} << false;
        QTest::newRow("high on the line") << QList<double>{66, 66, 66} << QList<double>{} << true;
        QTest::newRow("high in words") << QList<double>{} << QList<double>{6, 6, 6} << true;
        QTest::newRow("low in words") << QList<double>{} << QList<double>{4, 5, 5} << false;
        QTest::newRow("lower on the line than higher in words") << QList<double>{40, 40} << QList<double>{6, 6} << false;
        QTest::newRow("higher in words than lower on the line") << QList<double>{60, 60} << QList<double>{6, 6} << true;
    }
    void ratingsAreComparedWithinTheirQuestion()
    {
        QFETCH(QList<double>, line);
        QFETCH(QList<double>, words);
        QFETCH(bool, isFlagged);
        for (auto StudyData::*const low : {&StudyData::catchResponses, &StudyData::mismatchedResponses}) {
            StudyData data = onTwoScales();
            for (const double rating : line) (data.*low).push_back(builders::rated("P01", "F01", "f", "Q2", rating));
            for (const double rating : words) (data.*low).push_back(builders::rated("P01", "F01", "f", "Q3", rating));
            QCOMPARE(flagged(data).size(), qsizetype(isFlagged));
        }
    }

    /// Q2 has 2 catch trials, Q3 has 6: glass is lower in both, though its mean over all is higher (5.5 against 5).
    void questionsWithUnequalCatchTrialsAreNotMixed()
    {
        StudyData data =
            builders::emptyStudy(1, 12, oneCondition, {{"Q2", "", protocols::Rating{}}, {"Q3", "", protocols::Rating{}}});
        for (std::size_t i = 0; i < data.fabrics.size(); ++i) {
            data.responses.push_back(builders::rated("P01", data.fabrics[i], "f", "Q2", 1.0 + static_cast<double>(i % 3)));
            data.responses.push_back(builders::rated("P01", data.fabrics[i], "f", "Q3", 7.0 + static_cast<double>(i % 3)));
        }
        for (int i = 0; i < 2; ++i) data.catchResponses.push_back(builders::rated("P01", "F01", "f", "Q2", 1));
        for (int i = 0; i < 6; ++i) data.catchResponses.push_back(builders::rated("P01", "F01", "f", "Q3", 7));
        QCOMPARE(flagged(data), QStringList());
    }

    void mismatchesRatedHigh()
    {
        StudyData data = ratingsOf(different(12));
        for (const double rating : {0.6, 0.65, 0.7})
            data.mismatchedResponses.push_back(builders::rated("P01", "F01", "h&f", "Q2", rating));
        QCOMPARE(flagged(data),
                 QStringList("P01 mismatch_rated_high: 3 ratings of mismatched presentations (another fabric) have at "
                             "least the mean of the renderings' ratings"));
        data.mismatchedResponses.back().content = RatedAnswer{0.6};
        QCOMPARE(flagged(data), QStringList());
        QVERIFY(QString::fromStdString(mismatchRule()).contains("at least 3 such ratings"));
    }

    void voidedPresentationsAreFlaggedForTheStudy()
    {
        StudyData data = ratingsOf(different(12));
        data.voided = 1;
        QCOMPARE(flagged(data),
                 (QStringList{"all voided_presentations: 1 presentation was voided and presented again; answers to them are kept "
                              "and not analysed"}));
        data.voided = 2;
        QVERIFY(flagged(data).front().startsWith("all voided_presentations: 2 presentations were voided and presented again"));
    }

    void printedRulesCarryTheLimits()
    {
        const std::vector<std::string> sentences = ruleSentences();
        const auto says = [&](const std::string& text) {
            return std::any_of(sentences.begin(), sentences.end(),
                               [&](const std::string& one) { return one.find(text) != std::string::npos; });
        };
        for (const char* text :
             {"more than 5 % of the timed choices and ratings came within 0.5 s", "at least 50 % of the ratings",
              "60 % on 5 steps, 75 % on 4 steps and 100 % on 3 steps", "Scales of fewer steps flag nobody",
              "at least 80 % of the presentations", "at least 3 ratings of blank glass", "p times the number of slots below 0.01",
              "from 10 answers on"})
            QVERIFY2(says(text), text);
    }
};

QTEST_GUILESS_MAIN(QualityFlagsTest)
#include "quality_flags_test.moc"
