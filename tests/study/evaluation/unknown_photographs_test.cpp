// Photographs unlike the training photographs of a model: the warning of `render`, and the notice in status and report.
#include <QDir>
#include <QTemporaryDir>
#include <QtTest>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/photograph_features.h"
#include "tests/support/program.h"

using namespace rendering;
using support::mustRun;
namespace fs = std::filesystem;

namespace {

nlohmann::ordered_json readJson(const QString& file)
{
    return nlohmann::ordered_json::parse(protocols::readWholeFile(file.toStdString()));
}

int countIn(const QString& text, const char* part) { return static_cast<int>(text.count(part)); }

}  // namespace

class UnknownPhotographsTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    QString m_fabrics;

    QString path(const QString& name) const { return m_folder.filePath(name); }

    /// The shipped weights with a card that lists the photographs of these fabrics as training photographs. Without fabrics, the
    /// card has no such list.
    QString modelKnowing(const QString& name, const QStringList& fabrics) const
    {
        auto card = models::readModelCardFields(models::shippedModel());
        card.photographs.reset();
        std::vector<std::vector<float>> known;
        for (const QString& fabric : fabrics)
            for (const char* file : {"000.png", "001.png"})
                known.push_back(
                    models::photographFeatures(readPng((m_fabrics + "/" + fabric + "/visual/" + file).toStdString())));
        if (!known.empty()) card.photographs = models::fitFamiliarity(known, {});
        fs::copy_file(models::shippedModel(), path(name).toStdString());
        protocols::writeWholeFile(models::cardOf(path(name).toStdString()), models::cardText(card));
        return path(name);
    }

private Q_SLOTS:
    void initTestCase()
    {
        m_fabrics = path("fabrics");
        mustRun({"fabrics", "make", m_fabrics, "--fabrics", "8", "--samples", "2", "--seed", "5"});
    }

    void renderWarnsAndStoresTheDistances()
    {
        const QString model = modelKnowing("knows-all.safetensors", {"F01", "F02", "F03", "F04", "F05", "F06", "F07", "F08"});
        const auto known =
            mustRun({"render", m_fabrics, "--condition", "h_g", "--fabric", "F02", "--out", path("known"), "--model", model});
        QVERIFY2(!known.err.contains("unlike"), qPrintable(known.err));
        QCOMPARE(readJson(path("known/render.json"))["photographs"]["F02"]["unfamiliar"].get<bool>(), false);

        const QString other = modelKnowing("knows-one.safetensors", {"F01"});
        const auto ended =
            mustRun({"render", m_fabrics, "--condition", "h_g,v_grey", "--out", path("unknown"), "--model", other});
        QVERIFY2(ended.err.contains("photograph 0 of F05 differs from all training photographs (distance "),
                 qPrintable(ended.err));
        QVERIFY2(!ended.err.contains("photograph 0 of F01"), qPrintable(ended.err));
        const auto saved = readJson(path("unknown/render.json"))["photographs"]["F05"];
        QVERIFY(saved["distance"].get<double>() > saved["usual_distance"].get<double>());
        QVERIFY(saved["unfamiliar"].get<bool>());
    }

    void weightsWithoutAPhotographListWarnOnce()
    {
        const auto ended = mustRun({"render", m_fabrics, "--condition", "h_g,f_g", "--out", path("untold"), "--model",
                                    modelKnowing("old.safetensors", {})});
        QCOMPARE(countIn(ended.err, "the weights do not state"), 1);
        const auto saved = readJson(path("untold/render.json"))["photographs"]["F01"];
        QVERIFY(saved["distance"].is_null() && !saved["why"]["distance"].get<std::string>().empty());
        const auto none = mustRun({"render", m_fabrics, "--condition", "v_grey,h", "--out", path("none")});
        QVERIFY(!none.err.contains("these weights"));
    }

    void whatIsNoClothIsRefusedUnlessItIsWanted()
    {
        const QString strange = path("strange");
        fs::copy(m_fabrics.toStdString(), strange.toStdString(), fs::copy_options::recursive);
        const cv::Mat black(320, 320, CV_8UC3, cv::Scalar::all(0));
        for (const char* file : {"/F02/visual/000.png", "/F02/visual/001.png"}) writePng((strange + file).toStdString(), black);
        const auto refused = support::runProgram({"render", strange, "--condition", "h_g", "--out", path("refused")});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("photograph 0 of F02 does not look like cloth") && refused.err.contains("--even-strange"),
                 qPrintable(refused.err));
        QVERIFY(!QDir(path("refused")).exists());
        mustRun({"render", strange, "--condition", "v_grey,v_shape,h", "--out", path("seen")});
        const auto wanted = mustRun({"render", strange, "--condition", "h_g", "--out", path("wanted"), "--even-strange"});
        QVERIFY(wanted.err.contains("what is generated from it means nothing"));
        const auto photographs = readJson(path("wanted/render.json"))["photographs"];
        QCOMPARE(photographs["F02"]["likeness"].get<std::string>(), std::string("not_cloth"));
        QCOMPARE(photographs["F01"]["likeness"].get<std::string>(), std::string("cloth"));
    }

    void aStudyOfOtherThingsIsRefusedUnlessItIsWanted()
    {
        const QStringList study{
            "study",      "new", "--no-passphrase",          path("other"),    "--dataset", path("strange"), "--seed", "3",
            "--key-seed", "4",   "--allow-training-samples", "--participants", "2"};
        const auto refused = support::runProgram(study);
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("does not look like cloth"), qPrintable(refused.err));
        QVERIFY(!QDir(path("other")).exists());
        mustRun(study + QStringList{"--even-strange"});
        QVERIFY(mustRun({"study", "status", path("other")}).out.contains("does not look like cloth"));
    }

    void theCheckNamesEachPictureOfAFolder()
    {
        const auto checked = mustRun({"evaluate", path("strange/F02/visual"), "--cloth-check"});
        QVERIFY2(checked.out.contains("not_cloth: 2"), qPrintable(checked.out));
        const auto cloth = mustRun({"evaluate", m_fabrics + "/F01/visual", "--cloth-check", "--json"});
        const auto json = nlohmann::json::parse(cloth.out.toStdString());
        QCOMPARE(json.at("pictures").at(0).at("likeness").get<std::string>(), std::string("cloth"));
    }

    void statusAndReportRepeatTheWarning()
    {
        const QString model = modelKnowing("for-study.safetensors", {"F01"});
        for (const QString& study : {QString("study"), QString("again")}) {  // the second study reuses the images of the first
            const auto made =
                mustRun({"study", "new", "--no-passphrase", path(study), "--dataset", m_fabrics, "--seed", "3", "--key-seed", "4",
                         "--model", model, "--images", path("images"), "--allow-training-samples", "--participants", "2"});
            QVERIFY2(countIn(made.err, "differs from all training photographs") >= 6, qPrintable(made.err));
            mustRun({"study", "status", path(study), "--json", path(study + ".json")});
            QString stamps;
            const auto status = readJson(path(study + ".json"));
            for (const auto& stamp : status["stamps"]) stamps += QString::fromStdString(stamp.get<std::string>()) + "\n";
            QVERIFY2(countIn(stamps, "differs from all training photographs") >= 6, qPrintable(stamps));
        }
        mustRun({"simulate", path("study"), "--participants", "2", "--dataset", m_fabrics});
        mustRun({"report", path("study"), "--out", path("report")});
        const QString html = QString::fromStdString(protocols::readWholeFile(path("report/index.html").toStdString()));
        QVERIFY(html.contains("differs from all training photographs (distance "));
    }
};

QTEST_GUILESS_MAIN(UnknownPhotographsTest)
#include "unknown_photographs_test.moc"
