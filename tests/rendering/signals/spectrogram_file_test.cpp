#include "rendering/signals/spectrogram_file.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>

#include "rendering/images/image_io.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using namespace rendering::signals;

namespace {

namespace fs = std::filesystem;

std::vector<double> someTrace()
{
    std::vector<double> trace;
    for (int i = 0; i < 301; ++i) trace.push_back(0.4 + 0.1 * std::sin(0.6 * i) + 0.02 * std::cos(2.1 * i));
    return trace;
}

std::string textOf(const fs::path& file)
{
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

class SpectrogramFileTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void aSavedSpectrogramIsUndoneFromItsFileAlone()
    {
        const auto trace = someTrace();
        const SpectrogramParameters parameters{48, 12, 64, 250};
        writeSpectrogram(file(), stft(trace, parameters));
        const auto read = std::get<Spectrogram>(readSpectrogram(file()));
        QVERIFY(read.parameters == parameters);
        const auto back = istft(read);
        QCOMPARE(back.size(), trace.size());
        for (std::size_t i = 0; i < trace.size(); ++i) QVERIFY(std::abs(back[i] - trace[i]) <= 1e-12);
        for (const char* field :
             {"window_length", "hop", "fft_size", "sample_rate_hz", "trace_length", "mean", "hann", "mirrored"})
            QVERIFY2(textOf(file()).find(field) != std::string::npos, field);
    }

    void aMagnitudeKeepsItsMean()
    {
        const auto spectrogram = magnitude(stft(someTrace()));
        writeSpectrogram(file(), spectrogram);
        const auto read = std::get<MagnitudeSpectrogram>(readSpectrogram(file()));
        QCOMPARE(read.mean, spectrogram.mean);
        QCOMPARE(cv::norm(read.values, spectrogram.values, cv::NORM_INF), 0.0);
        QCOMPARE(griffinLim(read).trace, griffinLim(spectrogram).trace);
    }

    void spoiltFilesAreRefusedByName_data()
    {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QString>("said");
        QTest::newRow("another schema") << "spectrogram/1"
                                        << "velvet/1"
                                        << "is no spectrogram";
        QTest::newRow("no JSON") << "{"
                                 << ""
                                 << "malformed JSON";
        QTest::newRow("another kind") << "\"complex\""
                                      << "\"simple\""
                                      << "simple";
        QTest::newRow("hop of another spectrogram") << "\"hop\": 16"
                                                    << "\"hop\": 8"
                                                    << "as its parameters say";
        QTest::newRow("hop beyond the window") << "\"hop\": 16"
                                               << "\"hop\": 90"
                                               << "hop";
        QTest::newRow("a fraction") << "\"hop\": 16"
                                    << "\"hop\": 16.5"
                                    << "whole number";
        QTest::newRow("a transform beyond memory") << "\"fft_size\": 64"
                                                   << "\"fft_size\": 1000000000"
                                                   << "fft_size";
        QTest::newRow("trace of 1") << "\"trace_length\": 301"
                                    << "\"trace_length\": 1"
                                    << "as its parameters say";
        QTest::newRow("no mean") << "\"mean\""
                                 << "\"means\""
                                 << "mean";
    }
    void spoiltFilesAreRefusedByName()
    {
        QFETCH(QString, from);
        QFETCH(QString, to);
        QFETCH(QString, said);
        writeSpectrogram(file(), stft(someTrace()));
        QString text = QString::fromStdString(textOf(file()));
        QVERIFY(text.contains(from));
        std::ofstream(file()) << text.replace(text.indexOf(from), from.size(), to).toStdString();
        const auto refusal = refusalOf([&] { readSpectrogram(file()); });
        QVERIFY2(refusal.contains(said), qPrintable(refusal));
    }

    void valuesThatAreNoSpectrogramAreRefused()
    {
        writeSpectrogram(file(), magnitude(stft(someTrace())));
        auto values = rendering::readNpy(values_());
        values.at<double>(1, 1) = -1;
        rendering::writeNpy(values_(), values);
        QVERIFY(refusalOf([&] { readSpectrogram(file()); }).contains("negative"));
        values.at<double>(1, 1) = std::nan("");
        rendering::writeNpy(values_(), values);
        QVERIFY(refusalOf([&] { readSpectrogram(file()); }).contains("not finite"));
        values.at<double>(1, 1) = 1e308;  // found by reader_fuzz_test: the trace was no number
        rendering::writeNpy(values_(), values);
        QVERIFY(refusalOf([&] { readSpectrogram(file()); }).contains("beyond"));
        fs::remove(values_());
        QVERIFY(!refusalOf([&] { readSpectrogram(file()); }).isEmpty());
        QVERIFY(!refusalOf([&] { readSpectrogram(file().string() + "x"); }).isEmpty());
    }

private:
    fs::path file() const { return fs::path(m_folder.path().toStdString()) / "stroke.json"; }
    fs::path values_() const { return fs::path(m_folder.path().toStdString()) / "stroke.npy"; }
    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(SpectrogramFileTest)
#include "spectrogram_file_test.moc"
