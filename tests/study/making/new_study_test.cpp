// A new study is completely on the disk before it gets its name.
#include "study/making/new_study.h"

#include <QString>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "study/making/study_sheets.h"
#include "study/participant/sound/wav_sound.h"
#include "study/records/folder_audit.h"
#include "tests/support/error_text.h"
#include "tests/support/observed_disk.h"

using tests::support::DiskCall;
using tests::support::DiskStep;
using tests::support::ObservedDisk;

namespace {

namespace fs = std::filesystem;

/// Conditions without generated signals need no networks.
constexpr const char* protocolText = R"({"schema":"vis2hap.protocol/1","name":"small","participants":1,"fabrics":3,
  "conditions":["f"],"phases":[{"questions":["Q1"],"alternatives":3}]})";

std::vector<fs::path> filesIn(const fs::path& folder)
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder));
    return files;
}

}  // namespace

class NewStudyTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    fs::path at(const char* name) const { return fs::path(m_place.path().toStdString()) / name; }

    study::making::NewStudy requested()
    {
        study::making::NewStudy request;
        request.study = at("studies") / ("study" + std::to_string(++m_studies));
        request.dataset = at("fabrics");
        request.protocol = at("protocol.json");
        request.keySeed = 7;
        return request;
    }

private Q_SLOTS:
    void initTestCase()
    {
        rendering::fabrics::ProceduralOptions options;
        options.fabrics = 3;
        options.samples = 1;
        rendering::fabrics::makeProceduralFabrics(at("fabrics"), options);
        protocols::writeWholeFile(at("protocol.json"), protocolText);
        fs::create_directories(at("studies"));
    }

    void everyFileIsSyncedBeforeTheStudyGetsItsName()
    {
        const auto request = requested();
        const ObservedDisk disk(at("studies"));
        makeStudy(request);
        const auto steps = disk.steps();
        const auto named = std::find(steps.begin(), steps.end(), DiskStep{DiskCall::Rename, request.study});
        QVERIFY(named != steps.end());
        const auto files = filesIn(request.study);
        QCOMPARE(files.size(), std::size_t{8});  // protocol, two keys, database, three stimuli, the lock
        for (const fs::path& file : files) {
            const auto isOfFile = [&](const DiskStep& step) { return step.file.string().ends_with("/" + file.string()); };
            const auto renamed = std::find_if(std::make_reverse_iterator(named), steps.rend(), [&](const DiskStep& step) {
                return isOfFile(step) && step.call == DiskCall::Rename;
            });
            QVERIFY2(std::any_of(renamed.base(), named,
                                 [&](const DiskStep& step) { return isOfFile(step) && step.call == DiskCall::Sync; }),
                     file.c_str());
        }
        QVERIFY(std::find(named, steps.end(), DiskStep{DiskCall::Sync, at("studies")}) != steps.end());
    }

    void aDamagedManifestOfImagesCountsAsAbsent()
    {
        const auto isReused = [&] {
            auto request = requested();
            request.images = at("images");
            return makeStudy(request).imagesReused;
        };
        QVERIFY(!isReused() && isReused());
        const fs::path manifest = at("images") / "images.json";
        const std::string sound = protocols::readWholeFile(manifest);
        for (const char* signals :
             {R"({"image_warnings":5})", R"({"image_warnings":[7]})", R"({"prices":[5]})", R"({"t_tests":5})", "7"}) {
            auto json = nlohmann::ordered_json::parse(sound);
            json["signals"] = nlohmann::ordered_json::parse(signals);
            protocols::writeWholeFile(manifest, json.dump());
            QVERIFY2(!isReused() && isReused(), signals);
        }
    }

    /// The data set stays readable; a new study of it would have tables that no program reads.
    void aFabricWithAWordForMissingValuesIsRefused()
    {
        const fs::path set = at("missing");
        fs::copy(at("fabrics"), set, fs::copy_options::recursive);
        std::string description = protocols::readWholeFile(set / "dataset.json");
        for (std::size_t place; (place = description.find("\"F02\"")) != std::string::npos;)
            description.replace(place, 5, "\"NA\"");
        protocols::writeWholeFile(set / "dataset.json", description);
        fs::rename(set / "F02", set / "NA");
        QCOMPARE(rendering::fabrics::readDataset(set).fabrics[1].id.value, std::string("NA"));
        auto request = requested();
        request.dataset = set;
        const QString error = tests::support::errorOf([&] { requireInputs(request); });
        QVERIFY2(error.contains("\"NA\" cannot name a fabric: it stands for a missing value in tables"), qPrintable(error));
        QVERIFY(!fs::exists(request.study));
    }

    void ownEndsOfTheScaleWithUsualSentencesAreNamed()
    {
        const auto warningsWith = [&](const char* texts) {
            protocols::writeWholeFile(at("ends.json"),
                                      R"({"schema":"vis2hap.protocol/1","name":"ends","participants":1,"fabrics":3,
  "conditions":["f"],"participant_texts":)" +
                                          std::string(texts) + R"(,"phases":[{"questions":["Q2"],"scale":{"min":0,"max":10}}]})");
            auto request = requested();
            request.protocol = at("ends.json");
            QStringList warnings;
            for (const std::string& warning : makeStudy(request).warnings) warnings << QString::fromStdString(warning);
            return warnings.filter("participant_texts: ");
        };
        QCOMPARE(warningsWith("{}"), QStringList());
        const QStringList named = warningsWith(R"({"scale_low":"rough as bark"})");
        QCOMPARE(named.size(), 1);
        QVERIFY2(named[0].contains("scale_low, but no card_low, say_unrelated, say_ends; "), qPrintable(named[0]));
    }

    void failingDiskLeavesNoStudy()
    {
        std::vector<std::size_t> syncs;
        {
            const ObservedDisk disk(at("studies"));
            makeStudy(requested());
            const auto steps = disk.steps();
            for (std::size_t i = 0; i < steps.size(); ++i)
                if (steps[i].call != DiskCall::Write) syncs.push_back(i);
        }
        const auto before = filesIn(at("studies"));
        for (const std::size_t step : {syncs.front(), syncs[syncs.size() / 2], syncs[syncs.size() - 2]}) {
            ObservedDisk disk(at("studies"));
            disk.failAt(step, EIO);
            try {
                makeStudy(requested());
                QFAIL(qPrintable(QString("step %1 did not fail").arg(step)));
            } catch (const protocols::Error& fault) {
                QVERIFY2(fault.exitCode() == protocols::ExitCode::Environment, fault.what());
            }
            QCOMPARE(filesIn(at("studies")), before);
        }
    }

    void recordingsAreCopiedIntoTheStudyAndChecked()
    {
        const std::string start = R"({"prompts":{"wait":"warten.wav","question_Q1":"welches.wav"},)";
        fs::create_directories(at("spoken"));
        protocols::writeWholeFile(at("spoken") / "protocol.json", start + std::string(protocolText).substr(1));
        auto request = requested();
        request.protocol = at("spoken") / "protocol.json";
        QVERIFY_EXCEPTION_THROWN(makeStudy(request), protocols::Error);  // the recordings are missing
        const std::string wait = study::participant::wavOf({0.5F, 0}), which = study::participant::wavOf({0.25F, 0, 0});
        protocols::writeWholeFile(at("spoken") / "warten.wav", "no sound");
        protocols::writeWholeFile(at("spoken") / "welches.wav", which);
        QVERIFY_EXCEPTION_THROWN(makeStudy(request), protocols::Error);
        QVERIFY(!fs::exists(request.study));
        protocols::writeWholeFile(at("spoken") / "warten.wav", wait);
        makeStudy(request);
        const database::StudyFolder folder{request.study};
        QCOMPARE(protocols::readWholeFile(folder.prompt("wait")), wait);
        QCOMPARE(protocols::readWholeFile(folder.prompt("question_Q1")), which);
        const auto faults = [&] {
            return study::records::findingsInFolder(database::StudyStore(folder, database::StudyStore::Access::Read)).faults;
        };
        QVERIFY(faults().empty());
        protocols::writeWholeFile(folder.prompt("wait"), which);
        QCOMPARE(faults().size(), std::size_t(1));
        QVERIFY2(faults().front().starts_with("prompts/wait.wav: was altered"), faults().front().c_str());
        fs::remove(folder.prompt("wait"));
        QVERIFY2(faults().front().starts_with("prompts/wait.wav: is missing"), faults().front().c_str());
        protocols::writeWholeFile(folder.prompt("wait"), wait);
        protocols::writeWholeFile(folder.prompts() / "more.wav", wait);
        QVERIFY2(faults().front().starts_with("prompts/more.wav: does not belong"), faults().front().c_str());
    }

    /// A participant memorises the card. A mark stands for each word, and no scale of the study is missing.
    void eachScaleHasItsCard()
    {
        protocols::writeWholeFile(at("scales.json"),
                                  R"({"schema":"vis2hap.protocol/1","name":"scales","participants":1,"fabrics":3,
          "conditions":["f"],"question_texts":{"W1":"How rough?","W2":"How soft?"},"phases":[
            {"questions":["Q2","Q3"],"scale":{"min":0,"max":10,"step":0.1,"sections":9}},
            {"questions":["W1"],"scale":{"min":-3,"max":3,"step":1,"sections":9,"labels":["a","b","c","d","e","f","g"]}},
            {"questions":["W2"],"scale":{"min":1,"max":4,"step":1,"labels":["gar nicht","kaum","etwas","sehr"]}}]})");
        auto request = requested();
        request.protocol = at("scales.json");
        makeStudy(request);
        study::making::writeSheets({{request.study}, database::StudyStore::Access::Read}, at("sheets"));
        const auto cards =
            QString::fromStdString(protocols::readWholeFile(at("sheets") / "scale-card.html")).split("<div class=\"sheet\">");
        QCOMPARE(cards.size(), 4);
        const auto marks = [](const QString& card) { return card.count("stroke-width=\"4\""); };
        QCOMPARE(marks(cards[1]), 10);
        QCOMPARE(marks(cards[2]), 7);
        QCOMPARE(marks(cards[3]), 4);
        QVERIFY(cards[2].contains("How rough?") && cards[3].contains("gar nicht") && cards[3].contains("How soft?"));
    }

    void studyOfSimulatedParticipantsIsReplacedAsAWhole()
    {
        auto request = requested();
        makeStudy(request);
        protocols::writeWholeFile(request.study / "notes.txt", "of the earlier one");
        QVERIFY_EXCEPTION_THROWN(makeStudy(request), protocols::Error);
        QVERIFY(fs::exists(request.study / "notes.txt"));
        request.replaceSimulated = true;
        request.seed = 2;
        makeStudy(request);
        QVERIFY(!fs::exists(request.study / "notes.txt"));
        for (const auto& entry : fs::directory_iterator(at("studies")))
            QVERIFY2(!entry.path().filename().string().starts_with("."), entry.path().c_str());
    }
};

QTEST_GUILESS_MAIN(NewStudyTest)
#include "new_study_test.moc"
