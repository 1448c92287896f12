// Photographs that show no cloth: the refusal and warning of `render`, and the notice in status and report.
#include <QDir>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"
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

private Q_SLOTS:
    void initTestCase()
    {
        m_fabrics = path("fabrics");
        mustRun({"fabrics", "make", m_fabrics, "--fabrics", "8", "--samples", "2", "--seed", "5"});
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
        const QStringList options{
            "--dataset", path("strange"), "--seed", "3", "--key-seed", "4", "--allow-training-samples", "--participants", "2"};
        const auto refused = support::runProgram(QStringList{"study", "new", "--no-passphrase", path("other")} + options);
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("does not look like cloth"), qPrintable(refused.err));
        QVERIFY(!QDir(path("other")).exists());
        for (const QString& study : {QString("study"), QString("again")}) {  // the second study reuses the images of the first
            const auto made = mustRun(
                QStringList{"study", "new", "--no-passphrase", path(study), "--even-strange", "--images", path("images")} +
                options);
            QVERIFY2(countIn(made.err, "of F02 does not look like cloth") >= 1, qPrintable(made.err));
            QVERIFY(mustRun({"study", "status", path(study)}).out.contains("of F02 does not look like cloth"));
        }
        mustRun({"simulate", path("study"), "--participants", "2", "--dataset", path("strange")});
        mustRun({"report", path("study"), "--out", path("report")});
        const QString html = QString::fromStdString(protocols::readWholeFile(path("report/index.html").toStdString()));
        QVERIFY(html.contains("of F02 does not look like cloth"));
    }

    void theCheckNamesEachPictureOfAFolder()
    {
        std::filesystem::create_directory(path("strange/F02/visual/.Trash-1000").toStdString());
        std::ofstream(path("strange/F02/visual/.Trash-1000/older.png").toStdString()) << "no picture";
        std::ofstream(path("strange/F02/visual/._000.png").toStdString()) << "Mac OS X";
        const auto checked = mustRun({"evaluate", path("strange/F02/visual"), "--cloth-check"});
        QVERIFY2(checked.out.contains("not_cloth: 2") && !checked.out.contains("unreadable"), qPrintable(checked.out));
        std::filesystem::remove_all(path("strange/F02/visual/.Trash-1000").toStdString());
        std::filesystem::remove(path("strange/F02/visual/._000.png").toStdString());
        std::filesystem::copy(path("strange/F02/visual/000.png").toStdString(),
                              path("strange/F02/visual/DSC_1.PNG").toStdString());
        const auto ofCamera = mustRun({"evaluate", path("strange/F02/visual"), "--cloth-check"});
        QVERIFY2(ofCamera.out.contains("not_cloth: 3"), qPrintable(ofCamera.out));
        std::filesystem::remove(path("strange/F02/visual/DSC_1.PNG").toStdString());
        const auto cloth = mustRun({"evaluate", m_fabrics + "/F01/visual", "--cloth-check", "--json"});
        const auto json = nlohmann::json::parse(cloth.out.toStdString());
        QCOMPARE(json.at("pictures").at(0).at("likeness").get<std::string>(), std::string("cloth"));
    }
};

QTEST_GUILESS_MAIN(UnknownPhotographsTest)
#include "unknown_photographs_test.moc"
