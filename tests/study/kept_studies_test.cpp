// Studies that an earlier version made stay usable: they verify, export and report as they did, and a killed session continues.
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/program.h"

namespace {

using Json = nlohmann::ordered_json;
using support::mustRun;

QString kept(const QString& name) { return QString(VIS2HAP_SOURCE_DIR "/tests/study/kept/") + name; }

QByteArray bytesOf(const QString& file)
{
    QFile opened(file);
    if (!opened.open(QIODevice::ReadOnly)) qFatal("%s cannot be read", qPrintable(file));
    return opened.readAll();
}

Json jsonOf(const QString& file) { return Json::parse(bytesOf(file).toStdString()); }

/// Whether every number of `old` is in `now`, within a relative tolerance. `now` may contain more numbers, such as those of
/// worded questions since 0.6.0.
bool holds(const Json& now, const Json& old, double tolerance = 0)
{
    if (old.is_number() && tolerance > 0)
        return now.is_number() &&
               std::abs(now.get<double>() - old.get<double>()) <= tolerance * (1e-3 + std::abs(old.get<double>()));
    if (old.is_array())
        return now.is_array() && std::equal(now.begin(), now.end(), old.begin(), old.end(),
                                            [&](const Json& a, const Json& b) { return holds(a, b, tolerance); });
    if (!old.is_object()) return now == old;
    for (const auto& [key, value] : old.items()) {
        // Mixed models are fitted: another way to the optimum ends a little elsewhere.
        const bool isFitted = key.ends_with("lmm");
        if (!now.is_object() || !now.contains(key) || !holds(now[key], value, isFitted ? 1e-5 : tolerance)) return false;
    }
    return true;
}

/// Flags on voided presentations in the words of 0.5.0, which took every void for one with answers.
Json inTheOldWords(const Json& flags)
{
    static const QRegularExpression newer(
        QStringLiteral("voided and presented again; answers to them are kept and not analysed"));
    const QString text = QString::fromStdString(flags.dump());
    return Json::parse(
        QString(text).replace(newer, QStringLiteral("voided: kept in the data, not analysed, presented again")).toStdString());
}

/// results/2 has the questions under "questions"; results/1 had them at the top level.
Json inTheOldShape(const Json& results)
{
    Json old = Json::object();
    for (const auto& [key, value] : results.items()) {
        if (key == "schema")
            old[key] = "vis2hap.results/1";
        else if (key == "questions")
            for (const auto& [question, part] : value.items()) old[question] = part;
        else if (key == "quality")
            old[key] = inTheOldWords(value);
        else
            old[key] = value;
    }
    return old;
}

/// The export of `half` with the K-labels of 0.5.0 in place of the conditions. The key of `half` gives them.
QByteArray labelled(QByteArray csv) { return csv.replace(",f_g,\"[", ",K2,\"[").replace(",f,\"[", ",K1,\"["); }

/// Without the columns that answers have since 0.7.0: times before their entry, entries, where in the session they stand, and who
/// answered.
QByteArray inTheOldColumns(const QByteArray& csv)
{
    static const QRegularExpression newer(QStringLiteral(
        ",(touch_ended_at|\\d*),(answer_begun_at|\\d*),(answer_begun_by|script|),(entries|),(response_seconds|[-+.e\\d]*)"
        ",(place|\\d+),(attempt|\\d+),(sitting|\\d+),(state|[a-z]+),(kind|[a-z]+)\n"));
    return QString::fromUtf8(csv).replace(newer, QStringLiteral("\n")).toUtf8();
}

}  // namespace

class KeptStudiesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        QProcess tar;
        tar.start("tar", {"xzf", kept("studies-0.5.0.tar.gz"), "-C", m_folder->path()});
        QVERIFY(tar.waitForFinished());
        QCOMPARE(tar.exitCode(), 0);
    }

    void finishedStudyIsSound()
    {
        const Json verified = Json::parse(mustRun({"verify", at("finished"), "--json"}).out.toStdString());
        QVERIFY2(verified.at("sound") == true && verified.at("answers") == 157, verified.dump(1).c_str());
    }

    void finishedStudyExportsTheSameAnswers()
    {
        mustRun({"export", at("finished"), "--out", at("out"), "--format", "csv"});
        const QByteArray csv = bytesOf(at("out/answers.csv"));
        QVERIFY(csv.startsWith("participant,trial,") &&
                csv.contains(",entries,response_seconds,place,attempt,sitting,state,kind\n"));
        QCOMPARE(inTheOldColumns(csv), bytesOf(kept("finished-answers.csv")));
    }

    void finishedStudyReportsTheSameNumbers()
    {
        mustRun({"report", at("finished"), "--out", at("out")});
        const Json results = jsonOf(at("out/results.json"));
        QCOMPARE(results.at("schema").get<std::string>(), std::string("vis2hap.results/2"));
        const Json old = jsonOf(kept("finished-results.json")), now = inTheOldShape(results);
        for (const auto& [key, value] : old.items())  // some objects have more fields since 0.7.0
            QVERIFY2(now.contains(key) && holds(now[key], value), (key + ": " + now.value(key, Json()).dump()).c_str());
        const Json& signals = results.at("signals");
        QVERIFY(signals.at("controls").is_null() && signals.at("height_ssim_registered").is_null());
        QVERIFY(signals.at("why").at("controls").get<std::string>().find("earlier version") != std::string::npos);
        const Json statistics = jsonOf(at("out/statistics.json")), oldStatistics = jsonOf(kept("finished-statistics.json"));
        // "data" counts worded answers since 0.6.0. The d' of same and different was that of a choice until then.
        for (const auto& [key, value] : oldStatistics.items())
            if (key != "data" && key != "same_sensitivity") QVERIFY2(holds(statistics, Json{{key, value}}), key.c_str());
    }

    /// Its answers.csv has fewer columns than those of today; catch trials and trays are in it all the same.
    void anExportOfThatTimeGivesTheNumbersOfTheStudy()
    {
        mustRun({"report", at("finished"), "--out", at("out"), "--page-only"});
        mustRun({"report", "--from", kept("finished-answers.csv"), "--protocol", at("finished/protocol.json"), "--out",
                 at("table"), "--page-only"});
        const Json own = jsonOf(at("out/results.json")), read = jsonOf(at("table/results.json"));
        for (const char* part : {"conditions", "questions", "comparisons", "equivalence", "claims", "above_chance", "omnibus",
                                 "speed_accuracy", "quality"})
            QVERIFY2(own.contains(part) && read.contains(part) && read.at(part) == own.at(part), part);
    }

    void aPlanCanBeRegisteredLate()
    {
        const auto done = mustRun({"study", "preregister", at("finished")});
        QVERIFY2(done.out.contains("after 157 answers"), qPrintable(done.out));
        mustRun({"verify", at("finished")});
        mustRun({"report", at("finished"), "--out", at("out")});
        const Json plan = jsonOf(at("out/results.json")).at("preregistration");
        QVERIFY2(plan.at("registered") == true && plan.at("answers_before") == 157, plan.dump(1).c_str());
    }

    void wordedAnswersReachTheReport()
    {
        mustRun({"report", at("finished"), "--out", at("out")});
        QVERIFY(bytesOf(at("out/index.html")).contains("What made you decide?"));
        QVERIFY(bytesOf(at("out/index.html")).contains("ribs, &quot;3&quot;; rough"));
    }

    void killedSessionContinuesAtTheSameTrial()
    {
        const auto ended = mustRun({"replay", at("half"), kept("S03.json")});
        QVERIFY2(ended.out.contains("S03: 40 answers stored, finished"), qPrintable(ended.out));
        mustRun({"verify", at("half")});
        // Before the unblinding an export holds no answers since 0.7.0.
        mustRun({"export", at("half"), "--out", at("blinded"), "--format", "csv"});
        QVERIFY(!QFile::exists(at("blinded/answers.csv")) && QFile::exists(at("blinded/progress.csv")));
        mustRun({"unblind", at("half"), "--who", "Ada", "--why", "the last session is over"});
        mustRun({"export", at("half"), "--out", at("out"), "--format", "csv"});
        QCOMPARE(labelled(inTheOldColumns(bytesOf(at("out/answers.csv")))), bytesOf(kept("resumed-answers.csv")));
    }

    /// Of the folder as it lies there, and not of the upgraded copy that the command reads.
    void theDataSheetOfAnOldStudySaysThatNothingIsSealed()
    {
        const QString sheet = mustRun({"study", "data-sheet", at("finished")}).out.simplified();
        for (const QString& said :
             {at("finished"), QString("masked-key.json, mode"), QString("not encrypted: of an earlier version"),
              QString("Its images and keys lie open"), QString("are not sealed before the upgrade")})
            QVERIFY2(sheet.contains(said), qPrintable(said + " is not in: " + sheet));
        QVERIFY(!sheet.contains("(encrypted with the station key"));
    }

    void openingForWritingUpgradesAndKeepsTheStudyAsItWas()
    {
        const auto first = mustRun({"study", "preregister", at("finished")});
        QVERIFY2(first.err.contains("lies in " + at("finished/before-upgrade")), qPrintable(first.err));
        QVERIFY(QDir(at("finished/stimuli")).entryList({"*.pgm"}).isEmpty());
        QCOMPARE(QDir(at("finished/before-upgrade/stimuli")).entryList({"*.pgm"}).size(), 10);
        QVERIFY(!mustRun({"verify", at("finished")}).err.contains("earlier version"));
        mustRun({"verify", at("finished/before-upgrade")});
        QVERIFY(QFile::copy(at("finished/protocol.json"), at("finished/before-upgrade/answers of P3.txt")));
        const auto stray = support::runProgram({"verify", at("finished")});
        QCOMPARE(stray.exitCode, 1);
        QVERIFY2(stray.out.contains("before-upgrade/answers of P3.txt: does not belong to the study"), qPrintable(stray.out));
    }

private:
    QString at(const QString& name) const { return m_folder->filePath(name); }
    std::unique_ptr<QTemporaryDir> m_folder;
};

QTEST_GUILESS_MAIN(KeptStudiesTest)
#include "kept_studies_test.moc"
