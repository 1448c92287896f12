// Expected numbers: python3 tests/protocols/random_reference.py
#include "protocols/random.h"

#include <QTest>
#include <numeric>

using protocols::Random;

class RandomTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void wordsAreThoseOfThePublishedGenerator()
    {
        Random random(42);
        for (const std::uint64_t expected :
             {0x15780b2e0c2ec716ULL, 0x6104d9866d113a7eULL, 0xae17533239e499a1ULL, 0xecb8ad4703b360a1ULL})
            QCOMPARE(random.next(), expected);
    }

    void boundedDrawsAreTheSameEverywhere()
    {
        Random random(42);
        std::uint64_t checksum = 0;
        for (std::uint64_t i = 0; i < 1000; ++i) checksum = checksum * 31 + random.below(1 + i);
        QCOMPARE(checksum, 0x62cc5b390d1df33fULL);
    }

    void shuffleIsTheSameEverywhere()
    {
        Random random(5);
        std::vector<int> cards(10);
        std::iota(cards.begin(), cards.end(), 0);
        random.shuffle(cards);
        QCOMPARE(cards, (std::vector<int>{4, 2, 9, 3, 7, 1, 8, 6, 0, 5}));
    }

    void streamsOfDifferentPurposesDiffer()
    {
        Random photo = Random::stream(7, "photo/F03/17");
        QCOMPARE(photo.next(), 0xa6bf81201a268f8dULL);
        QCOMPARE(photo.next(), 0xe1c0f0c50e9a42ecULL);
        QVERIFY(Random::stream(7, "photo/F03/18").next() != Random::stream(7, "photo/F03/17").next());
        QVERIFY(Random::stream(8, "photo/F03/17").next() != Random::stream(7, "photo/F03/17").next());
    }

    void boundedDrawsAreUniform()
    {
        Random random(1);
        std::vector<int> counts(7, 0);
        for (int i = 0; i < 70'000; ++i) ++counts[random.below(7)];
        for (const int count : counts) QVERIFY2(std::abs(count - 10'000) < 400, qPrintable(QString::number(count)));
    }

    void normalDrawsHaveTheirMoments()
    {
        Random random(3);
        double sum = 0;
        double squares = 0;
        constexpr int draws = 100'000;
        for (int i = 0; i < draws; ++i) {
            const double x = random.normal();
            sum += x;
            squares += x * x;
        }
        QVERIFY(std::abs(sum / draws) < 0.013);  // four standard errors
        QVERIFY(std::abs(squares / draws - 1) < 0.018);
    }

    void uniformDrawsStayInTheirRange()
    {
        Random random(4);
        double least = 1;
        double most = 0;
        for (int i = 0; i < 10'000; ++i) {
            const double x = random.uniform();
            least = std::min(least, x);
            most = std::max(most, x);
            const double y = random.uniform(-3, -2);
            QVERIFY(y >= -3 && y < -2);
        }
        QVERIFY(least >= 0 && least < 0.01 && most > 0.99 && most < 1);
    }
};

QTEST_GUILESS_MAIN(RandomTest)
#include "random_test.moc"
