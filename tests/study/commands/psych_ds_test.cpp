// Data sets of `export --format psych-ds` against the rules of the published specification Psych-DS 1.5, one test a rule. The
// rules are read from its schema; files are parsed here by code that the exporter does not use.
#include "study/exports/psych_ds.h"

#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/strict_json.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"
#include "tests/study/commands/psych_ds_files.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using nlohmann::json;
using support::mustRun;
using support::runProgram;
using namespace tests::support;
namespace fs = std::filesystem;

namespace {

const std::set<std::string> officialKeywords{"study",     "site",  "subject",  "session",    "task",
                                             "condition", "trial", "stimulus", "description"};

/// Properties of schema.org that the metadata use, by type, and the types of the objects that a property takes.
const std::map<std::string, std::set<std::string>> propertiesOfType{
    {"Dataset",
     {"name", "description", "schemaVersion", "identifier", "keywords", "license", "citation", "datePublished", "author",
      "variableMeasured"}},
    {"PropertyValue", {"name", "description", "unitText", "minValue", "maxValue", "valueReference"}},
    {"DefinedTerm", {"name"}},
    {"QuantitativeValue", {"name", "minValue", "maxValue"}},
    {"Person", {"name"}}};
const std::map<std::string, std::set<std::string>> typesOfProperty{
    {"variableMeasured", {"PropertyValue"}}, {"author", {"Person"}}, {"valueReference", {"DefinedTerm", "QuantitativeValue"}}};

/// The name of the study, as hostile as a protocol may have it.
const std::string hostileName = "Ä \"quoted\" 'name' </script><b>&amp; | *stars* \\ ,;\n# second line\t=1+1";

std::string hostileProtocol()
{
    json protocol = json::parse(R"({
      "schema": "vis2hap.protocol/1", "participants": 7, "fabrics": ["F01", "F02", "F03"], "conditions": ["v_grey", "h&f"],
      "phases": [{"questions": ["Q1"], "alternatives": 3, "catch_trials": 1},
                 {"questions": ["Feel", "Why"], "scale": {"min": 1, "max": 7, "step": 0.5, "sections": 1}, "free_text": ["Why"],
                  "instructions": [{"id": "quick", "aim": "speed"}, {"id": "slow", "text": "Take 1 s.", "deadline_seconds": 1}]},
                 {"questions": ["Same"], "same_different": true}],
      "question_texts": {"Feel": "How close?", "Why": "What did you feel?", "Same": "Is it the same?"}, "dead_time_seconds": 0})");
    protocol["name"] = "hostile";
    return protocol.dump();
}

}  // namespace

class PsychDsTest : public QObject {
    Q_OBJECT

    QTemporaryDir m_place;
    std::vector<Dataset> m_datasets;

    QString at(const QString& name) const { return m_place.filePath(name); }

    void add(const QString& name, const QString& study, const QStringList& more = {})
    {
        mustRun(QStringList{"export", study, "--format", "psych-ds", "--out", at("set-" + name)} + more);
        m_datasets.push_back(datasetIn(name, at("set-" + name).toStdString()));
    }

    const Dataset& dataset(const QString& name) const
    {
        return *std::ranges::find_if(m_datasets, [&](const Dataset& one) { return one.name == name; });
    }

    static void play(const QString& study, const std::string& participant)
    {
        OpenSession session({study.toStdString()}, participant);
        session.stepUntil("Presenting");
        session.send(study::session::Noted{"=note, with \"quotes\" and\nlines", true});
        session.playUntilAnswers(1);
        session.send(study::session::Voided{"wrong piece"});
        session.playToEnd();
    }

    QString played(const QString& name, const StudyRecipe& recipe, const std::vector<std::string>& participants)
    {
        buildStudy(at(name).toStdString(), recipe);
        for (const std::string& participant : participants) play(at(name), participant);
        return at(name);
    }

private Q_SLOTS:
    /// Each study is exported blinded and unblinded; every rule below holds for all data sets.
    void initTestCase()
    {
        // 42 answers under a label to the question with two instructions, and to each of the plain study.
        const std::vector<std::string> hostilePeople{"=1+1 \"Ö\"", "<b>&amp;", "Ä;+2", "P04", "P05", "P06", "P07"};
        std::vector<std::string> allButOne;
        for (int one = 10; one < 23; ++one) allButOne.push_back("P" + std::to_string(one));
        const QString sealed = played("sealed", {.passphrase = "open sesame"}, {"P01"});
        const QString plain = played("plain", {.participants = 14}, allButOne);
        const QString hostile = played("hostile", {.protocol = hostileProtocol()}, hostilePeople);
        renameAsBefore((hostile + "/study.db").toStdString(), hostileName);
        json lengthy = json::parse(protocolText({}));
        lengthy["name"] = QString(500, u'ü').toStdString();
        const QString longNamed = played("long", {.protocol = lengthy.dump()}, {});
        add("sealed", sealed);
        add("unfinished", plain);
        play(plain, "P23");
        add("labels", plain);
        add("hostile-labels", hostile, {"--with-log"});
        for (const QString& study : {plain, hostile, longNamed}) mustRun({"unblind", study, "--who", "M", "--why", "done"});
        add("plain", plain);
        add("hostile", hostile);
        add("raw", plain, {"--with-log", "--with-samples"});
        add("long", longNamed);  // nobody took part
        add("public", hostile, {"--public", "--author", "A. \"B\" </script>", "--author", "Ö", "--licence", "CC0-1.0"});
        QCOMPARE(m_datasets.size(), std::size_t{9});
    }

    // Files and folders.
    void metadataLieAtTheRootOnly()
    {
        for (const Dataset& one : m_datasets)
            for (const auto& [path, bytes] : one.files)
                QVERIFY2((fileNameIn(path) != "dataset_description.json") == (path != "dataset_description.json"),
                         one.says(path));
        for (const Dataset& one : m_datasets) QVERIFY2(one.files.contains("dataset_description.json"), one.says("none"));
    }
    void theDataFolderHoldsADataFile()
    {
        for (const Dataset& one : m_datasets) QVERIFY2(!one.tables.empty(), one.says("no data file"));
    }
    void readmeAndChangesExistOnce()
    {
        for (const Dataset& one : m_datasets)
            for (const char* name : {"README.", "CHANGES."}) {
                const auto isNamed = [&](const auto& file) { return fileNameIn(file.first).starts_with(name); };
                QVERIFY2(std::ranges::count_if(one.files, isNamed) == 1, one.says(name));
                QVERIFY2(one.files.contains(std::string(name) + "md"), one.says(name));
            }
    }
    void noFileIsEmpty()
    {
        for (const Dataset& one : m_datasets)
            for (const auto& [path, bytes] : one.files) QVERIFY2(!bytes.empty(), one.says(path));
    }
    void materialsHoldTheProtocol()
    {
        json stored = json::parse(hostileProtocol());
        stored["name"] = hostileName;
        QVERIFY(json::parse(dataset("hostile").files.at("materials/protocol-1.json")) == stored);
        QVERIFY(!dataset("hostile-labels").files.contains("materials/protocol-1.json"));
    }
    void rawDataStayApartFromDataFiles()
    {
        for (const char* file : {"data/raw/log.csv", "data/raw/acts.csv", "data/raw/finger_samples.csv"})
            QVERIFY2(dataset("raw").files.contains(file), file);
        QVERIFY(dataset("raw").tables == dataset("plain").tables);
    }
    void filesOutsideTheSpecificationAreIgnored()
    {
        const std::set<std::string> specified{"dataset_description.json", "README.md", "CHANGES.md", ".psychds-ignore"};
        for (const Dataset& one : m_datasets)
            for (const auto& [path, bytes] : one.files) {
                const std::string pattern = path.starts_with("data/raw/") ? "data/raw/" : path;
                const bool isKnown = specified.contains(path) || isDataFile(path) || path.starts_with("materials/");
                QVERIFY2(isKnown || ("\n" + one.files.at(".psychds-ignore")).find("\n" + pattern + "\n") != std::string::npos,
                         one.says(path));
            }
    }

    // Names of data files.
    void dataFilesEndWithData()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets)) QVERIFY2(path.ends_with("_data.csv"), one.says(path));
    }
    void namesConsistOfKeywordsAndValues()
    {
        static const QRegularExpression form("^[a-z]+-[a-zA-Z0-9]+(_[a-z]+-[a-zA-Z0-9]+)*_data\\.csv$");
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            QVERIFY2(form.match(QString::fromStdString(fileNameIn(path))).hasMatch(), one.says(path));
    }
    void keywordsAreOfficial()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            for (const auto& [word, value] : keywordsIn(path)) QVERIFY2(officialKeywords.contains(word), one.says(path));
    }
    void keywordValuesAreAlphanumeric()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            for (const auto& [word, value] : keywordsIn(path)) QVERIFY2(isAlphanumeric(value), one.says(path));
    }
    void namesOfStudiesDoNotCollide()
    {
        using study::exports::keywordValue;
        QCOMPARE(keywordValue("Pilot2"), std::string("Pilot2"));
        std::vector<std::string> names{"", "ab", "a b", "a-b", "a_b", "ab ", "ä", "ö", "触", "</script>", "\"", "x", "X"};
        for (const char end : {'1', '2'}) names.push_back(std::string(500, 'n') + end);
        for (const char* name : {"a b", "ä"}) names.push_back(keywordValue(name));  // a name that looks like a made value
        for (std::size_t i = 0; i < 2; ++i) names.push_back(keywordValue(names[names.size() - 2]));
        std::set<std::string> values;
        for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
            const std::string value = keywordValue(name);
            QVERIFY2(values.insert(value).second, (name + " -> " + value).c_str());
            QVERIFY2(isAlphanumeric(value) && value.size() < 60, value.c_str());
        }
    }

    // Data files.
    void dataFilesAreCsv()
    {
        QVERIFY(!csvRows("a,b\n1,\"2\n") && !csvRows("a\n\nb\n") && !csvRows("a\"b\n"));
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            QVERIFY2(csvRows(one.files.at(path)).has_value(), one.says(path));
    }
    void dataFilesAreUtf8WithoutBom()
    {
        for (const Dataset& one : m_datasets)
            for (const auto& [path, bytes] : one.files) {
                QVERIFY2(!protocols::firstByteThatIsNotUtf8(bytes), one.says(path));
                QVERIFY2(!bytes.starts_with("\xef\xbb\xbf"), one.says(path));
            }
    }
    void everyDataFileHasAHeader()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets)) {
            QVERIFY2(!rows.empty(), one.says(path));
            for (const std::string& name : rows.front()) QVERIFY2(!name.empty(), one.says(path));
        }
        QCOMPARE(dataset("long").tables.size(), std::size_t{2});  // without participants headers alone
    }
    void noColumnNameTwice()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            QVERIFY2(std::set<std::string>(rows[0].begin(), rows[0].end()).size() == rows[0].size(), one.says(path));
    }
    void eachRowHasAsManyCells()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            for (const auto& row : rows) QVERIFY2(row.size() == rows.front().size(), one.says(path));
    }
    /// A column of this name would have to be unique.
    void noColumnIsCalledRowId()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            QVERIFY2(std::ranges::find(rows.front(), "row_id") == rows.front().end(), one.says(path));
    }
    void theColumnsThatTheReadmeNamesAreAKey()
    {
        for (const char* name : {"plain", "hostile"}) {
            const Dataset& one = dataset(name);
            QVERIFY(one.files.at("README.md").find("`participant`, `trial` and `question` name one row") != std::string::npos);
            const Rows& rows = one.answers();
            std::set<std::vector<std::string>> keys;
            std::size_t voided = 0;
            for (std::size_t i = 1; i < rows.size(); ++i)
                if (cellAt(rows, i, "voided") == "1")
                    ++voided;
                else
                    QVERIFY(keys.insert({cellAt(rows, i, "participant"), cellAt(rows, i, "trial"), cellAt(rows, i, "question")})
                                .second);
            QVERIFY(voided == (name == std::string("plain") ? 14 : 7) && keys.size() > 20);
        }
    }

    // Metadata.
    void metadataAreJsonInUtf8()
    {
        for (const Dataset& one : m_datasets) {
            const std::string& text = one.files.at("dataset_description.json");
            QVERIFY2(one.metadata.is_object() && !protocols::firstByteThatIsNotUtf8(text), one.says(text));
            protocols::JsonDocument(text, "dataset_description.json");  // throws for a doubled key
        }
    }
    void metadataAreJsonLd()
    {
        for (const Dataset& one : m_datasets)
            for (const auto& [object, property] : objectsIn(one.metadata))
                for (const auto& [key, value] : object.items()) {
                    QVERIFY2(!key.starts_with("@") || key == "@type" || (key == "@context" && property.empty()), one.says(key));
                    QVERIFY2(!value.is_null() && !(value.is_array() && value.empty()), one.says(key));
                }
    }
    void onlyTheVocabularyOfSchemaOrgIsUsed()
    {
        for (const Dataset& one : m_datasets) {
            QVERIFY2(one.metadata.value("@context", "") == "https://schema.org/", one.says("context"));
            for (const auto& [object, property] : objectsIn(one.metadata))
                for (const auto& [key, value] : object.items()) QVERIFY2(key.find(':') == std::string::npos, one.says(key));
        }
    }
    void theTypeIsDataset()
    {
        for (const Dataset& one : m_datasets) QVERIFY2(one.metadata.at("@type") == "Dataset", one.says("type"));
    }
    void requiredKeysAreThere()
    {
        for (const Dataset& one : m_datasets) {
            for (const char* key : {"name", "description"})
                QVERIFY2(one.metadata.at(key).is_string() && !one.metadata[key].get<std::string>().empty(), one.says(key));
            QVERIFY2(one.metadata.at("variableMeasured").is_array(), one.says("variableMeasured"));
        }
    }
    void recommendedKeysAreThereWhereTheyAreKnown()
    {
        const json& open = dataset("public").metadata;
        QCOMPARE(open.at("author").size(), std::size_t{2});
        QCOMPARE(open.at("author")[0], (json{{"@type", "Person"}, {"name", "A. \"B\" </script>"}}));
        QCOMPARE(open.at("author")[1].at("name"), json("Ö"));
        QCOMPARE(open.at("license"), json("https://spdx.org/licenses/CC0-1.0.html"));
        QVERIFY(dataset("public").files.contains(open.at("citation").get<std::string>()));
        for (const Dataset& one : m_datasets)
            for (const char* key : {"identifier", "keywords"}) QVERIFY2(one.metadata.contains(key), one.says(key));
    }
    void theVersionOfTheSpecificationIsStated()
    {
        for (const Dataset& one : m_datasets) QVERIFY2(one.metadata.at("schemaVersion") == "Psych-DS 1.5.1", one.says("version"));
    }
    void everyObjectHasAType()
    {
        for (const Dataset& one : m_datasets)
            for (const auto& [object, property] : objectsIn(one.metadata))
                QVERIFY2(object.contains("@type"), one.says(property + " " + object.dump()));
    }
    void everyPropertyBelongsToItsType()
    {
        for (const Dataset& one : m_datasets)
            for (const auto& [object, property] : objectsIn(one.metadata)) {
                const auto known = propertiesOfType.find(object.value("@type", ""));
                QVERIFY2(known != propertiesOfType.end(), one.says(object.dump()));
                for (const auto& [key, value] : object.items())
                    QVERIFY2(key.starts_with("@") || known->second.contains(key), one.says(key));
            }
    }
    void everyObjectFitsItsProperty()
    {
        for (const Dataset& one : m_datasets)
            for (const auto& [object, property] : objectsIn(one.metadata)) {
                if (property.empty()) continue;
                const auto types = typesOfProperty.find(property);
                QVERIFY2(types != typesOfProperty.end() && types->second.contains(object.value("@type", "")), one.says(property));
            }
    }

    // Metadata and columns.
    void everyColumnIsDescribed()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            for (const std::string& column : rows.front())
                QVERIFY2(variablesOf(one).contains(column), one.says(path + " " + column));
    }
    void everyDescribedVariableIsAColumn()
    {
        for (const Dataset& one : m_datasets) {
            std::set<std::string> left = variablesOf(one);
            QVERIFY2(left.size() == one.metadata["variableMeasured"].size(), one.says("a variable occurs twice"));
            for (const auto& [path, rows] : one.tables)
                for (const std::string& column : rows.front()) left.erase(column);
            QVERIFY2(left.empty(), one.says(left.empty() ? "" : *left.begin()));
        }
    }
    void everyCellHasADescribedLevelOrLiesInItsRange()
    {
        for (const auto& [one, path, rows] : dataFilesOf(m_datasets))
            for (std::size_t i = 1; i < rows.size(); ++i)
                for (const std::string& column : rows.front()) {
                    const std::string fault =
                        faultOfCell(variableOf(one, column), cellAt(rows, i, column), cellAt(rows, i, "question"));
                    QVERIFY2(fault.empty(), one.says(path + " " + column + ": " + fault));
                }
    }

    // What this program promises beyond the specification.
    void tablesAndCodebookAreThoseOfTheCsvExport()
    {
        for (const char* name : {"plain", "hostile"}) {
            const Dataset& one = dataset(name);
            mustRun({"export", at(name), "--out", at(QString("csv-") + name)});
            const fs::path csv = at(QString("csv-") + name).toStdString();
            QCOMPARE(one.answers(), *csvRows(protocols::readWholeFile(csv / "answers.csv")));
            QCOMPARE(one.tables.rbegin()->second, *csvRows(protocols::readWholeFile(csv / "participants.csv")));
            const Rows codebook = *csvRows(protocols::readWholeFile(csv / "codebook.csv"));
            for (std::size_t i = 1; i < codebook.size(); ++i) {
                const json* variable = variableOf(one, codebook[i][1]);
                QVERIFY2(variable != nullptr && variable->value("unitText", "") == codebook[i][3], codebook[i][1].c_str());
                QVERIFY2((*variable)["description"].get<std::string>().starts_with(codebook[i][5]), codebook[i][5].c_str());
            }
        }
    }
    void aHostileNameStaysText()
    {
        for (const char* name : {"hostile", "hostile-labels", "public"}) {
            const Dataset& one = dataset(name);
            QCOMPARE(one.metadata["name"].get<std::string>(), hostileName);
            QVERIFY2(one.files.at("dataset_description.json").find('<') == std::string::npos, name);
            for (const char* file : {"README.md", "CHANGES.md"})
                QVERIFY2(one.files.at(file).find('<') == std::string::npos, file);
            QVERIFY(one.files.at("README.md").starts_with("# Ä \"quoted\" 'name' &lt;/script>&lt;b>&amp;amp; \\| \\*stars\\* "));
        }
    }
    void aBlindedDatasetHoldsProgressOnly()
    {
        const QStringList withoutMeans{"sealed", "unfinished"};  // no key, and a place that is not finished
        for (const char* name : {"sealed", "unfinished", "labels", "hostile-labels"}) {
            const Dataset& one = dataset(name);
            QCOMPARE(one.tables.size(), std::size_t(withoutMeans.contains(name) ? 3 : 4));
            for (const auto& [path, bytes] : one.files)
                for (const char* word : {"v_grey", "h&f", "F01", "F02", "F03", "=note", "as number"})
                    QVERIFY2(bytes.find(word) == std::string::npos, one.says(path + " holds " + word));
        }
        for (const QString& name : withoutMeans)
            for (const auto& [path, bytes] : dataset(name).files)
                for (const char* word : {"K1", "\"correct\"", "\"share\"", "\"mean\"", "ounded means"})
                    QVERIFY2(bytes.find(word) == std::string::npos, path.c_str());
        const auto refused = runProgram({"export", at("sealed"), "--format", "psych-ds", "--public", "--out", at("early")});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("cannot be published") && !QFile::exists(at("early")), qPrintable(refused.err));
    }
    void aPublicDatasetHasNoDaysNotesOrWords()
    {
        const Dataset& one = dataset("public");
        QVERIFY(!variablesOf(one).contains("wall_time") && !variablesOf(one).contains("note"));
        for (const auto& [path, bytes] : one.files)
            if (isDataFile(path))
                for (const char* word : {"as number", "=note"}) QVERIFY2(bytes.find(word) == std::string::npos, path.c_str());
        QVERIFY(dataset("hostile").answers().size() > one.answers().size());
    }
    void badInputIsRefused()
    {
        const auto unknown = runProgram({"export", at("plain"), "--format", "bids", "--out", at("bids")});
        QCOMPARE(unknown.exitCode, 2);
        for (const char* format : {"csv", "json", "script", "psych-ds"}) QVERIFY2(unknown.err.contains(format), format);
        const auto taken = runProgram({"export", at("plain"), "--format", "psych-ds", "--out", at("set-plain")});
        QCOMPARE(taken.exitCode, 2);
        QVERIFY2(taken.err.contains("needs a folder of its own"), qPrintable(taken.err));
        QVERIFY(datasetIn("plain", at("set-plain").toStdString()).files == dataset("plain").files);
        QVERIFY(QDir().mkdir(at("empty")));
        mustRun({"export", at("plain"), "--format", "psych-ds", "--out", at("empty")});
        QVERIFY(mustRun({"export", "--help"}).out.contains("psych-ds"));
    }
};

QTEST_GUILESS_MAIN(PsychDsTest)
#include "psych_ds_test.moc"
