// The rehearsal as an operator does it before the first participant comes, and what it must not touch.
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <QLabel>
#include <QLineEdit>
#include <QTest>
#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <filesystem>
#include <map>
#include <set>

#include "database/disk/server_note.h"
#include "database/disk/station_key.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "rendering/display/stimulus_bank.h"
#include "study/app/pages/setup/rehearsal_page.h"
#include "study/app/pages/setup/room_checks.h"
#include "study/making/rehearsal.h"
#include "tests/support/error_text.h"
#include "tests/support/open_window.h"

using namespace study::app;
using tests::support::OpenWindow;
namespace fs = std::filesystem;

namespace {

bool hasNamelessFiles = true;  ///< false: as sticks and network shares

std::map<std::string, std::string> bytesIn(const fs::path& folder)
{
    std::map<std::string, std::string> hashes;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) hashes[entry.path().string()] = protocols::sha256OfFile(entry.path());
    return hashes;
}

/// What somebody sees of a study who reads every file of its folder, and opens the images with the key beside them.
struct SeenFolder {
    explicit SeenFolder(const fs::path& folder)
    {
        const database::StudyStore store({folder}, database::StudyStore::Access::Read);
        const auto key = database::readStationKey(store.folder(), store.facts().stationKeySha256);
        rendering::StimulusBank bank(store.folder().stimuli(), store.stimulusHashes(), key);
        keyText = key.hex();
        for (const auto& [code, hash] : store.stimulusHashes()) {
            const cv::Mat& image = bank.imageOf(code);
            fileNames.insert(code.value);
            fileHashes.insert(hash);
            images.insert(protocols::sha256(std::string(image.datastart, image.dataend)));
        }
        for (const auto& slot : store.slots())
            for (const auto& trial : store.trials(slot.number)) {
                sealedCodes.insert(trial.sealedCode.value);
                presentationCodes.insert(trial.presentationCode.value);
            }
        for (const auto& item : store.facts().familiarisation) sealedCodes.insert(item.sealedCode.value);
    }

    std::string keyText;
    std::set<std::string> fileNames, fileHashes, images, sealedCodes, presentationCodes;
};

std::set<std::string> shared(const std::set<std::string>& a, const std::set<std::string>& b)
{
    std::set<std::string> both;
    std::ranges::set_intersection(a, b, std::inserter(both, both.end()));
    return both;
}

/// Files that a presentation of the study may show, by its presentation code, after many rehearsals were watched. Each rehearsal
/// says: the file of every presentation that it repeats is one of the files that it holds.
std::map<std::string, std::set<std::string>> filesLeft(const SeenFolder& study, const std::vector<SeenFolder>& rehearsals)
{
    std::map<std::string, std::set<std::string>> left;
    for (const auto& code : study.presentationCodes) left[code] = study.fileNames;
    for (const auto& rehearsal : rehearsals) {
        const auto files = shared(study.fileNames, rehearsal.fileNames);
        if (files.empty()) continue;
        for (const auto& code : shared(study.presentationCodes, rehearsal.presentationCodes))
            left[code] = shared(left[code], files);
    }
    return left;
}

}  // namespace

/// The linker prefers this definition to that of the C library.
extern "C" int open(const char* file, int flags, ...)
{
    const bool isNameless = (flags & O_TMPFILE) == O_TMPFILE;
    if (isNameless && !hasNamelessFiles) {
        errno = EOPNOTSUPP;
        return -1;
    }
    va_list rest;
    va_start(rest, flags);
    const auto mode = isNameless || (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : mode_t{};
    va_end(rest);
    return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, file, flags, mode));
}

class AppRehearsalTest : public tests::support::WindowTest {
    Q_OBJECT

    /// The folder of the latest rehearsal is kept in m_last.
    AppOptions options()
    {
        AppOptions given;
        given.makeRehearsal = [this](const fs::path& study) {
            auto made = study::making::makeRehearsal(study);
            m_last = *made;
            return made;
        };
        return given;
    }
    static RehearsalPage& pageOf(OpenWindow& open) { return *qobject_cast<RehearsalPage*>(open.window().currentPage()); }
    static QString shownIn(OpenWindow& open, const char* name) { return open.widget<QLabel>(name).text(); }
    static void type(OpenWindow& open, const QString& code)
    {
        auto& line = open.widget<QLineEdit>("rehearsalPieceField");
        line.setFocus();
        QTest::keyClicks(&line, code);
        QTest::keyClick(&line, Qt::Key_Return);
    }
    static void tick(OpenWindow& open, const char* name) { QTest::keyClick(&open.widget<QWidget>(name), Qt::Key_Space); }

    fs::path m_last;

private Q_SLOTS:
    void everythingTriedIsReadyForTheFirstParticipant();
    void nothingOfItTouchesTheStudy();
    void manyRehearsalsGiveNothingAway();
    void aMissingImageOfTheStudyIsFound();
    void aMissingDatabaseOfTheStudyIsFound();
    void aStudyOnAServerIsNotRehearsed();
    void aSessionThatWasLeftIsStillMissing();
    void whatIsMissingIsNamed();
    void theComputerIsChecked();
    void windowWithoutARehearsalShowsNoButton();
};

void AppRehearsalTest::everythingTriedIsReadyForTheFirstParticipant()
{
    OpenWindow open(newStudy(), options(), {});
    open.gui().pressKey(Qt::Key_F8);
    QCOMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    for (const char* box : {"rehearsalFelt", "rehearsalHeard", "rehearsalSheets"}) tick(open, box);
    const QStringList codes = open.window().study()->codesOnPieces();
    QVERIFY(codes.size() >= 3);
    type(open, "no such code");
    QVERIFY(open.message("rehearsalMessage").contains("is no code of this study"));
    const auto& message = open.widget<QLabel>("rehearsalMessage");
    QVERIFY(message.y() > open.widget<QLineEdit>("rehearsalPieceField").y());
    QVERIFY(message.y() < open.widget<QLabel>("rehearsalComputer").y());
    for (const QString& code : codes) type(open, code);
    QCOMPARE(shownIn(open, "rehearsalPieces"), QString("Every fabric piece is there."));
    QCOMPARE(shownIn(open, "rehearsalResult"), QString("Still missing: a session played to its end."));
    open.gui().pressKey(Qt::Key_F5);
    QCOMPARE(open.window().currentPage()->objectName(), QString("sessionPage"));
    QCOMPARE(shownIn(open, "participantFact"), QString("REHEARSAL: nothing becomes data"));
    QCOMPARE(open.window().windowTitle(), QString("Rehearsal – %1 – Vis2Hap").arg(open.window().study()->name()));
    open.playToEnd();
    open.gui().pressKey(Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QCOMPARE(shownIn(open, "rehearsalResult"), QString("Ready for P01."));
    QTest::keyClick(open.window().currentPage(), Qt::Key_Escape);
    QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
}

void AppRehearsalTest::nothingOfItTouchesTheStudy()
{
    const auto study = newStudy();
    OpenWindow open(study, options(), {});
    const auto before = bytesIn(study.folder);
    const auto head = database::textOf(open.window().study()->store().head());
    open.gui().pressKey(Qt::Key_F8);
    open.gui().pressKey(Qt::Key_F5);
    const auto& plan = open.gui().plan();
    QVERIFY(plan.trials.size() < open.window().study()->store().trials(1).size());
    QVERIFY(fs::exists(m_last));
    open.playToEnd();
    open.gui().pressKey(Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QVERIFY(!fs::exists(m_last));
    QCOMPARE(database::textOf(open.window().study()->store().head()), head);
    QVERIFY(bytesIn(study.folder) == before);
    QVERIFY(open.window().study()->store().enrolments().empty());
}

// An operator starts rehearsals again and again, and compares their files and trials with those of the study.
void AppRehearsalTest::manyRehearsalsGiveNothingAway()
{
    tests::support::StudyRecipe recipe{.fabrics = 4, .conditions = {"v_grey", "h", "h&f"}, .participants = 4};
    recipe.familiarisationImages = 2;
    recipe.hasSwatchCodes = true;
    const auto folder = newStudy(recipe);
    const SeenFolder study(folder.folder);
    std::vector<SeenFolder> rehearsals;
    std::set<std::string> images;
    std::size_t codes = 0, imagesInAll = 0, codesByChance = 0;
    for (int start = 0; start < 10; ++start) {
        const auto made = study::making::makeRehearsal(folder.folder);
        const SeenFolder& seen = rehearsals.emplace_back(*made);
        QVERIFY(seen.keyText != study.keyText);
        QVERIFY(shared(seen.fileNames, study.fileNames).empty());
        QVERIFY(shared(seen.fileHashes, study.fileHashes).empty());
        QVERIFY(shared(seen.images, study.images).empty());
        QVERIFY(shared(seen.sealedCodes, study.sealedCodes).empty());
        for (const auto& entry : fs::recursive_directory_iterator(*made)) {
            if (!entry.is_regular_file() || entry.path().extension() == ".sealed") continue;
            const std::string bytes = protocols::readWholeFile(entry.path());
            QVERIFY(bytes.find(study.keyText) == std::string::npos);
            for (const auto* texts : {&study.fileNames, &study.fileHashes, &study.sealedCodes})
                for (const auto& text : *texts) QVERIFY2(bytes.find(text) == std::string::npos, text.c_str());
        }
        codes += seen.presentationCodes.size();
        codesByChance += shared(seen.presentationCodes, study.presentationCodes).size();
        imagesInAll += seen.images.size();
        images.insert(seen.images.begin(), seen.images.end());
    }
    // Four letters of 22 are the same by chance for one code in thousands.
    QVERIFY2(codesByChance * 10 < codes, std::to_string(codesByChance).c_str());
    // No image comes twice, so that not even the rehearsals have one in common.
    QCOMPARE(images.size(), imagesInAll);
    for (const auto& [code, files] : filesLeft(study, rehearsals)) QCOMPARE(files.size(), study.fileNames.size());
}

void AppRehearsalTest::aMissingImageOfTheStudyIsFound()
{
    const auto study = newStudy();
    OpenWindow open(study, options(), {});
    fs::remove(fs::directory_iterator(study.stimuli())->path());
    open.gui().pressKey(Qt::Key_F8);
    open.gui().pressKey(Qt::Key_F5);
    QCOMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QVERIFY(open.message("rehearsalMessage").contains("the stimulus is missing"));
}

void AppRehearsalTest::aMissingDatabaseOfTheStudyIsFound()
{
    const auto study = newStudy();
    OpenWindow open(study, options(), {});
    open.gui().pressKey(Qt::Key_F8);
    QVERIFY(shownIn(open, "rehearsalComputer").startsWith("The disk is in order."));
    fs::remove(study.database());
    open.gui().pressKey(Qt::Key_F7);
    QTRY_VERIFY2(shownIn(open, "rehearsalComputer").startsWith("study.db is no longer in the study's folder"),
                 qPrintable(shownIn(open, "rehearsalComputer")));
    QVERIFY(shownIn(open, "rehearsalResult").startsWith("Still missing:"));
}

void AppRehearsalTest::aStudyOnAServerIsNotRehearsed()
{
    const auto study = newStudy();
    database::writeServerNote(study.folder, {"postgresql://a@b/lab?study=x", "left", std::string(64, 'a'), false});
    const QString refusal = tests::support::errorOf([&] { study::making::makeRehearsal(study.folder); });
    QVERIFY2(refusal.contains("lie on the server") && refusal.contains("before the study moves there"), qPrintable(refusal));
}

void AppRehearsalTest::aSessionThatWasLeftIsStillMissing()
{
    OpenWindow open(newStudy(), options(), {});
    open.gui().pressKey(Qt::Key_F8);
    open.gui().pressKey(Qt::Key_F5);
    open.playTo("Presenting");
    open.gui().pressKey(Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QVERIFY(open.message("rehearsalMessage").contains("left before its end"));
    QVERIFY(!pageOf(open).tried().sessionWasPlayed);
    QVERIFY(!fs::exists(m_last));
    // A second one begins anew.
    open.gui().pressKey(Qt::Key_F5);
    QCOMPARE(open.view().answersStored, 0);
}

void AppRehearsalTest::whatIsMissingIsNamed()
{
    AppOptions without = options();
    OpenWindow open(newStudy(), without);
    open.gui().pressKey(Qt::Key_F8);
    RehearsalState nothing;
    nothing.piecesLeft = {"663"};
    nothing.diskFault = nothing.clockFault = "fault";
    QCOMPARE(nothing.missing().size(), 7);
    nothing.displayIsThere = true;
    QVERIFY(nothing.missing().contains("a test pattern that was felt"));
    QVERIFY(!nothing.missing().contains("a display"));
    // What was ticked stays while the page of the display is visited.
    tick(open, "rehearsalHeard");
    open.gui().pressKey(Qt::Key_F6);
    QCOMPARE(open.window().currentPage()->objectName(), QString("displayPage"));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_Escape);
    QCOMPARE(open.window().currentPage()->objectName(), QString("rehearsalPage"));
    QVERIFY(pageOf(open).tried().soundWasHeard);
    QVERIFY(!shownIn(open, "rehearsalResult").contains("masking"));
}

void AppRehearsalTest::theComputerIsChecked()
{
    QCOMPARE(faultOfDisk(filePath(".").toStdString()), QString());
    QVERIFY(faultOfDisk(filePath("nowhere").toStdString()).contains("cannot be asked"));
    const fs::path stick = filePath("stick").toStdString();
    fs::create_directory(stick);
    hasNamelessFiles = false;
    QCOMPARE(faultOfDisk(stick), QString());
    hasNamelessFiles = true;
    QVERIFY(fs::is_empty(stick));
    if (fs::exists("/proc")) QVERIFY(!faultOfDisk("/proc").isEmpty());
    QCOMPARE(faultOfClocks("2020-01-01T00:00:00.000+01:00"), QString());
    QVERIFY(faultOfClocks("2999-01-01T00:00:00.000+01:00").contains("behind the last entry"));
}

void AppRehearsalTest::windowWithoutARehearsalShowsNoButton()
{
    OpenWindow open(newStudy());
    QVERIFY(!open.window().findChild<QWidget*>("rehearsalButton")->isVisible());
}

QTEST_MAIN(AppRehearsalTest)
#include "app_rehearsal_test.moc"
