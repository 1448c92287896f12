// Every reference case of the shared oracle, answered by the functions behind `vis2hap analyse`, with the
// digits that the case asks for.
#include <QTest>
#include <nlohmann/json.hpp>

#include "study/analyse/analyse.h"
#include "tests/stats/oracle_cases.h"

namespace {

struct Family {
    std::filesystem::path file;
    std::string name;
};

std::vector<Family> families()
{
    std::vector<Family> found;
    for (const char* folder : {"oracle/cases/public", "oracle/ssim/public"}) {
        std::error_code absent;
        for (const auto& entry : std::filesystem::directory_iterator(oracle::sharedFolder() / folder, absent))
            if (entry.path().extension() == ".json") found.push_back({entry.path(), entry.path().stem().string()});
    }
    std::sort(found.begin(), found.end(), [](const Family& a, const Family& b) { return a.name < b.name; });
    return found;
}

}  // namespace

class OracleTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void familyAgreesWithItsReferenceCases_data()
    {
        QTest::addColumn<QString>("file");
        for (const Family& family : families())
            QTest::newRow(family.name.c_str()) << QString::fromStdString(family.file.string());
        if (families().empty()) QTest::newRow("absent") << QString();
    }

    void familyAgreesWithItsReferenceCases()
    {
        QFETCH(QString, file);
        if (file.isEmpty()) QSKIP("the shared reference cases are missing: nothing was compared (set VIS2HAP_SHARED)");
        const std::filesystem::path path = file.toStdString();
        std::ifstream stream(path);
        const oracle::Json document = oracle::Json::parse(stream);
        QVERIFY(!document["cases"].empty());
        int wrong = 0;
        for (const oracle::Json& one : document["cases"]) {
            const oracle::Json answer = study::analyse::answerOf(one, path.parent_path());
            const QString faults = oracle::fault(one, answer);
            if (faults.isEmpty()) continue;
            ++wrong;
            qWarning("%s: %s", one["id"].get<std::string>().c_str(), qPrintable(faults));
        }
        qInfo("%s: %zu cases, %d wrong", path.stem().c_str(), document["cases"].size(), wrong);
        QCOMPARE(wrong, 0);
    }
};

QTEST_GUILESS_MAIN(OracleTest)
#include "oracle_test.moc"
