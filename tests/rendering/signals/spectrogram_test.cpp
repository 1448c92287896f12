#include "rendering/signals/spectrogram.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <opencv2/core.hpp>

#include "protocols/random.h"
#include "rendering/signals/friction_trace.h"
#include "tests/rendering/refusal.h"

using namespace rendering::signals;

namespace {

/// Friction like that of a fabric: a mean, the period of the yarns, a slow drift, and noise.
std::vector<double> fabricTrace(int length, double mean = 0.55)
{
    protocols::Random random(11);
    std::vector<double> trace;
    for (int i = 0; i < length; ++i)
        trace.push_back(mean + 0.04 * std::sin(0.7 * i) + 0.02 * std::sin(0.05 * i) + 0.01 * random.normal());
    return trace;
}

double meanOf(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double largestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
    double largest = a.size() == b.size() ? 0 : std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

bool allFinite(const std::vector<double>& values)
{
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

rendering::fabrics::FrictionRecord recordOf(std::vector<double> timeS, std::vector<double> values)
{
    rendering::fabrics::FrictionRecord record;
    record.timeS = std::move(timeS);
    record.values = std::move(values);
    return record;
}

}  // namespace

class SpectrogramTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void complexSpectrogramGivesTheTraceBack_data()
    {
        QTest::addColumn<int>("length");
        QTest::addColumn<int>("window");
        QTest::addColumn<int>("hop");
        QTest::addColumn<int>("fft");
        for (const int length : {2, 3, 17, 31, 32, 33, 64, 100, 480, 481, 495})
            QTest::addRow("%d samples", length) << length << 64 << 16 << 64;
        QTest::newRow("hop of half the window") << 480 << 64 << 32 << 64;
        QTest::newRow("longer transform") << 300 << 48 << 12 << 128;
        QTest::newRow("odd transform") << 300 << 33 << 8 << 45;
    }
    void complexSpectrogramGivesTheTraceBack()
    {
        QFETCH(int, length);
        QFETCH(int, window);
        QFETCH(int, hop);
        QFETCH(int, fft);
        const auto trace = fabricTrace(length);
        const auto spectrogram = stft(trace, {window, hop, fft, 60});
        QCOMPARE(spectrogram.values.rows, fft / 2 + 1);
        QCOMPARE(spectrogram.values.cols, 1 + length / hop);
        QVERIFY(largestDifference(istft(spectrogram), trace) <= 1e-12);
    }

    void spectrumIsTheSumOfItsDefinition()
    {
        const auto trace = fabricTrace(90);
        const auto spectrogram = stft(trace);
        const auto at = [&](int place) {  // Mirrored about the end samples.
            place = std::abs(place);
            return trace[static_cast<std::size_t>(place < 90 ? place : 178 - place)];
        };
        for (const int frame : {0, 2, 5})
            for (const int k : {0, 1, 7, 32}) {
                double real = 0, imaginary = 0;
                for (int n = 0; n < 64; ++n) {
                    const double hann = std::pow(std::sin(std::numbers::pi * n / 64), 2);
                    real += hann * at(frame * 16 - 32 + n) * std::cos(2 * std::numbers::pi * k * n / 64);
                    imaginary -= hann * at(frame * 16 - 32 + n) * std::sin(2 * std::numbers::pi * k * n / 64);
                }
                const auto bin = spectrogram.values.at<cv::Vec2d>(k, frame);
                QVERIFY(std::hypot(bin[0] - real, bin[1] - imaginary) < 1e-12);
            }
    }

    void aToneStandsInItsRow()
    {
        std::vector<double> tone;
        for (int i = 0; i < 256; ++i) tone.push_back(0.25 * std::cos(2 * std::numbers::pi * 8 * i / 64));
        const auto magnitudes = magnitude(stft(tone)).values;
        QVERIFY(std::abs(magnitudes.at<double>(8, 8) - 0.25 * 32 / 2) < 1e-12);
        QVERIFY(magnitudes.at<double>(12, 8) < 1e-12);
    }

    void meanSurvivesTheMagnitudeAlone_data()
    {
        QTest::addColumn<double>("mean");
        for (const double mean : {0.2, 0.55, 1.3}) QTest::addRow("mu %.2f", mean) << mean;
    }
    void meanSurvivesTheMagnitudeAlone()
    {
        QFETCH(double, mean);
        const auto trace = fabricTrace(480, mean);
        auto spectrogram = magnitude(stft(trace));
        // A generator without its own mean only has the row of frequency 0.
        spectrogram.mean = meanFromMagnitude(spectrogram.values, spectrogram.parameters);
        const auto inversion = griffinLim(spectrogram);
        QVERIFY(std::abs(meanOf(inversion.trace) / meanOf(trace) - 1) <= 0.001);
    }

    void carriedMeanIsMetExactly()
    {
        auto spectrogram = magnitude(stft(fabricTrace(481)));
        spectrogram.mean = 0.7;
        const auto inversion = griffinLim(spectrogram);
        QCOMPARE(inversion.trace.size(), std::size_t(481));
        QVERIFY(std::abs(meanOf(inversion.trace) - 0.7) < 1e-12);
    }

    void moreIterationsMeetTheMagnitudeBetter()
    {
        const auto trace = fabricTrace(480);
        const auto spectrogram = magnitude(stft(trace));
        auto none = GriffinLimOptions{};
        none.iterations = 0;
        const double start = griffinLim(spectrogram, none).spectralConvergence;
        const double fast = griffinLim(spectrogram, GriffinLimOptions::of(InversionQuality::Fast)).spectralConvergence;
        const double accurate = griffinLim(spectrogram, GriffinLimOptions::of(InversionQuality::Accurate)).spectralConvergence;
        qInfo("spectral convergence: %.3f at the start, %.3f fast, %.3f accurate", start, fast, accurate);
        QVERIFY(fast < 0.5 * start);
        QVERIFY(accurate < fast);
        QVERIFY(accurate < 0.1);
    }

    void convergenceIsReportedIterationByIteration()
    {
        const auto inversion = griffinLim(magnitude(stft(fabricTrace(480))), GriffinLimOptions::of(InversionQuality::Accurate));
        const auto& course = inversion.convergence;
        QCOMPARE(course.size(), std::size_t(200));
        QVERIFY(course.front() > 3 * course.back());
        QVERIFY(course[20] < course[0] && course[199] < course[20]);
        // The last entry belongs to the trace before the last iteration, so it is close to the final figure.
        QVERIFY(std::abs(course.back() - inversion.spectralConvergence) < 0.02);
        const std::vector<double> flat(480, 0.4);
        for (const double value : griffinLim(magnitude(stft(flat))).convergence) QVERIFY(std::isfinite(value));
    }

    void aMeanIsNotReadWhereWindowsDoNotAddUp()
    {
        const auto trace = fabricTrace(480);
        const SpectrogramParameters odd{64, 27, 64, 60};  // Invertible, but with uneven weights of the samples.
        const auto spectrogram = magnitude(stft(trace, odd));
        QVERIFY(refusalOf([&] { meanFromMagnitude(spectrogram.values, odd); }).contains("do not add up"));
        QVERIFY(refusalOf([] { requireConstantOverlap({64, 48, 64, 60}); }).contains("48"));
        for (const int hop : {1, 2, 4, 8, 16, 32})
            QVERIFY(refusalOf([&] { requireConstantOverlap({64, hop, 64, 60}); }).isEmpty());
    }

    void aLongTraceComesBackToo()
    {
        std::vector<double> trace(1000000);
        for (std::size_t i = 0; i < trace.size(); ++i) trace[i] = 0.5 + 0.1 * std::sin(0.3 * static_cast<double>(i));
        QVERIFY(largestDifference(istft(stft(trace)), trace) <= 1e-12);
    }

    void sameSeedGivesTheSameTrace()
    {
        const auto spectrogram = magnitude(stft(fabricTrace(200)));
        QCOMPARE(griffinLim(spectrogram).trace, griffinLim(spectrogram).trace);
        QVERIFY(griffinLim(spectrogram).trace != griffinLim(spectrogram, {.seed = 2}).trace);
    }

    void constantTraceStaysConstant_data()
    {
        QTest::addColumn<double>("level");
        QTest::newRow("0.4") << 0.4;
        QTest::newRow("0") << 0.0;
    }
    void constantTraceStaysConstant()
    {
        QFETCH(double, level);
        const std::vector<double> trace(480, level);
        const auto inversion = griffinLim(magnitude(stft(trace)));
        QVERIFY(allFinite(inversion.trace));
        QVERIFY(largestDifference(inversion.trace, trace) < 1e-9);
        QVERIFY(std::isfinite(inversion.spectralConvergence));
    }

    void singlePrecisionMagnitudeIsTaken()
    {
        auto spectrogram = magnitude(stft(fabricTrace(480)));
        const auto inDouble = griffinLim(spectrogram, {.iterations = 4}).trace;
        spectrogram.values.convertTo(spectrogram.values, CV_32F);
        QVERIFY(largestDifference(griffinLim(spectrogram, {.iterations = 4}).trace, inDouble) < 1e-3);
    }

    void whatCannotBeInvertedIsRefused_data()
    {
        QTest::addColumn<int>("window");
        QTest::addColumn<int>("hop");
        QTest::addColumn<int>("fft");
        QTest::newRow("hop as long as the window, whose ends have weight 0") << 64 << 64 << 64;
        QTest::newRow("hop beyond the window") << 64 << 80 << 64;
        QTest::newRow("window beyond the transform") << 64 << 16 << 32;
        QTest::newRow("hop of 0") << 64 << 0 << 64;
    }
    void whatCannotBeInvertedIsRefused()
    {
        QFETCH(int, window);
        QFETCH(int, hop);
        QFETCH(int, fft);
        const auto trace = fabricTrace(200);
        QVERIFY(!refusalOf([&] { stft(trace, {window, hop, fft, 60}); }).isEmpty());
    }

    void badValuesAreRefused()
    {
        auto trace = fabricTrace(100);
        trace[40] = std::numeric_limits<double>::quiet_NaN();
        QVERIFY(refusalOf([&] { stft(trace); }).contains("not finite"));
        QVERIFY(refusalOf([&] { stft(std::vector<double>{0.5}); }).contains("at least 2"));
        auto spectrogram = magnitude(stft(fabricTrace(100)));
        spectrogram.values.at<double>(3, 2) = -0.1;
        QVERIFY(refusalOf([&] { griffinLim(spectrogram); }).contains("negative"));
        spectrogram.traceLength = 300;
        QVERIFY(refusalOf([&] { griffinLim(spectrogram); }).contains("300"));
    }

    void evenRecordIsTakenAsItIs()
    {
        auto record = recordOf({}, fabricTrace(480));
        for (int i = 0; i < 480; ++i) record.timeS.push_back(std::round(i / 60.0 * 1000) / 1000);  // Whole milliseconds.
        const auto trace = frictionTrace(record, "000.csv");
        QCOMPARE(trace.values, record.values);
        QCOMPARE(trace.mmPerSample, 5.0 / 60);
        QCOMPARE(trace.mean, meanOf(record.values));
    }

    void unevenTimesAreMadeEven()
    {
        // A straight line, sampled at uneven times near 36 Hz, below the 60 Hz of the data set.
        std::vector<double> times, values;
        protocols::Random random(5);
        for (double t = 3; t < 8; t += 0.02 + 0.016 * random.uniform()) {
            times.push_back(t);
            values.push_back(0.1 * t);
        }
        const auto trace = frictionTrace(recordOf(times, values), "slide.csv");
        QVERIFY(trace.sampleRateHz < 40 && trace.sampleRateHz > 32);
        for (std::size_t i = 0; i < trace.values.size(); ++i)
            QVERIFY(std::abs(trace.values[i] - 0.1 * (3 + static_cast<double>(i) / trace.sampleRateHz)) < 1e-9);
        QVERIFY(std::abs(trace.mmPerSample * trace.sampleRateHz - 5) < 1e-12);
    }

    void denserRecordIsAveraged()
    {
        // 600 Hz with a tone at 180 Hz: without averaging, 60 Hz would alias the tone to a constant.
        std::vector<double> times, values;
        for (int i = 0; i < 3000; ++i) {
            times.push_back(i / 600.0);
            values.push_back(0.5 + 0.2 * std::cos(2 * std::numbers::pi * 180 * i / 600.0));
        }
        const auto trace = frictionTrace(recordOf(times, values), "dense.csv");
        QCOMPARE(trace.sampleRateHz, 60.0);
        QVERIFY(trace.values.size() >= 299);
        for (std::size_t i = 1; i + 1 < trace.values.size(); ++i) QVERIFY(std::abs(trace.values[i] - 0.5) < 0.03);
    }

    void otherQuantitiesMayBeNegative()
    {
        auto record = recordOf({}, fabricTrace(480));
        for (double& value : record.values) value = -value;
        record.quantity = "deflection_um";
        QCOMPARE(frictionTrace(record, "000.csv").mean, meanOf(record.values));
    }

    void unusableRecordIsRefusedByName_data()
    {
        QTest::addColumn<QString>("kind");
        QTest::addColumn<QString>("said");
        QTest::newRow("short") << "short"
                               << "only 5 samples";
        QTest::newRow("NaN") << "nan"
                             << "sample 8";
        QTest::newRow("time runs back") << "back"
                                        << "do not increase";
        QTest::newRow("no rate") << "rate"
                                 << "sample rate";
        QTest::newRow("clock set an hour forward") << "jump"
                                                   << "gap in time";
        QTest::newRow("stamps that hardly differ") << "tiny"
                                                   << "sample rate of inf Hz";
        QTest::newRow("axis against the stroke") << "against"
                                                 << "axis points against the stroke";
        QTest::newRow("no friction at all") << "zero"
                                            << "mean coefficient of friction is 0;";
    }
    void unusableRecordIsRefusedByName()
    {
        QFETCH(QString, kind);
        QFETCH(QString, said);
        auto record = recordOf({}, fabricTrace(kind == "short" ? 5 : 50));
        for (std::size_t i = 0; i < record.values.size(); ++i) record.timeS.push_back(static_cast<double>(i) / 60);
        if (kind == "nan") record.values[7] = std::numeric_limits<double>::quiet_NaN();
        if (kind == "back") record.timeS[20] = record.timeS[19];
        if (kind == "rate") record.sampleRateHz = 0;
        if (kind == "against" || kind == "zero")
            for (double& value : record.values) value *= kind == "zero" ? 0 : -1;
        if (kind == "jump") record.timeS.back() += 3600;
        if (kind == "tiny")
            for (std::size_t i = 0; i < record.timeS.size(); ++i) record.timeS[i] = 1e-320 * static_cast<double>(i);
        const auto refusal = refusalOf([&] { frictionTrace(record, "F02/friction/004.csv"); });
        QVERIFY2(refusal.contains(said) && refusal.contains("F02/friction/004.csv"), qPrintable(refusal));
    }
};

QTEST_GUILESS_MAIN(SpectrogramTest)
#include "spectrogram_test.moc"
