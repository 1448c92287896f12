// A lab's own program as a condition: from the protocol to the report, and programs that fail in every way.
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>
#include <QSet>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>

#include "protocols/files/sha256.h"
#include "rendering/images/image_io.h"
#include "tests/support/program.h"

using support::mustRun;
using support::runProgram;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* smallText =
    R"({"schema": "vis2hap.protocol/1", "name": "own program", "participants": 3,
    "fabrics": ["F01", "F02", "F03", "F04", "F05"], "conditions": ["h", {"id": "mine", "program": true}],
    "planned": [["mine", "h"]],
    "phases": [{"questions": ["Q1"], "alternatives": 3}, {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";

constexpr const char* elevenText =
    R"({"schema": "vis2hap.protocol/1", "name": "eleven", "participants": 10, "fabrics": 7,
    "conditions": ["v_grey", "v_shape", "f_g", "h_g", "h_g&f_g", "t_grey", "f", "h", "h&f",
                   {"id": "ready", "images": "ready"}, {"id": "mine", "program": true}],
    "planned": [["mine", "h&f"], ["mine", "ready"]],
    "phases": [{"questions": ["Q1"], "alternatives": 3}, {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";

/// A plain image in the shell: every pixel has the level of the character.
constexpr const char* plainImage = "{ printf 'P5\\n1280 800\\n255\\n'; head -c 1024000 /dev/zero | tr '\\000' 'a'; } > \"$2\"\n";

const QString examples = QString(VIS2HAP_SOURCE_DIR) + "/protocols/examples/";

Json jsonIn(const QString& file)
{
    std::ifstream in(file.toStdString());
    return Json::parse(in);
}

QByteArray bytesIn(const QString& file)
{
    QFile open(file);
    return open.open(QIODevice::ReadOnly) ? open.readAll() : QByteArray();
}

cv::Mat noise(int seed)
{
    cv::Mat image(800, 1280, CV_8UC1);
    cv::RNG(seed).fill(image, cv::RNG::UNIFORM, 0, 256);
    return image;
}

/// Whether a process with this word among its arguments runs.
bool runsWith(const QByteArray& word)
{
    for (const QString& process : QDir("/proc").entryList(QDir::Dirs))
        if (process[0].isDigit() && bytesIn("/proc/" + process + "/cmdline").split('\0').contains(word)) return true;
    return false;
}

}  // namespace

class OwnProgramTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        write("small.json", smallText);
        write("eleven.json", elevenText);
        mustRun({"fabrics", "make", path("fabrics"), "--fabrics", "8", "--samples", "4", "--seed", "5"});
        QDir().mkpath(path("ready"));
        for (int number = 1; number <= 8; ++number)
            rendering::writePng(path(QString("ready/F0%1.png").arg(number)).toStdString(), noise(number));
        QDir().mkpath(path("tmp"));
    }

    /// The nine, ready images and a program in one study.
    void readyImagesAndAProgramBesideTheNineAreOneStudy()
    {
        const QStringList owner{"VIS2HAP_PASSPHRASE=correct horse battery"};
        const QStringList program{"--program", "mine=python3 " + examples + "own_program.py"};
        const auto made = newStudy("eleven", "eleven.json", program, owner, Key::Sealed);
        QVERIFY2(made.exitCode == 0, qPrintable(made.err));
        QVERIFY2(made.err.contains("1 condition shows ready images") &&
                     made.err.contains("1 condition shows images of a program of the laboratory"),
                 qPrintable(made.err));
        QVERIFY(QDir(path("tmp")).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot));
        QVERIFY(QDir(path("eleven")).entryList({"*.png", "*.ppm", "*photograph*"}).isEmpty());
        QSet<qint64> sizes;
        for (const QFileInfo& file : QDir(path("eleven/stimuli")).entryInfoList(QDir::Files)) sizes.insert(file.size());
        QCOMPARE(sizes.size(), 1);
        mustRun({"simulate", path("eleven")}, owner);
        mustRun({"verify", path("eleven")});

        // The seed of the key, which makes this test the same in each run, is all that there is to find.
        const auto leaks = runProgram({"leak-check", path("eleven")}, owner);
        QVERIFY2(leaks.out.contains("learned condition") && leaks.out.contains("without both keys: not above chance"),
                 qPrintable(leaks.out + leaks.err));
        QVERIFY2(leaks.out.count("finding: ") == 1 && leaks.out.contains("(--key-seed)") && !leaks.out.contains("***"),
                 qPrintable(leaks.out));
        const Json status = Json::parse(mustRun({"study", "status", path("eleven"), "--json"}).out.toStdString());
        QVERIFY(status["balance"].size() > 10);
        for (const Json& range : status["balance"]) {
            const std::string what = range["what"];
            if (what.find("slots") != std::string::npos && what.find("per participant") != std::string::npos) continue;
            QVERIFY2(range["max"].get<int>() - range["min"].get<int>() <= 5, range.dump().c_str());
        }

        mustRun({"report", path("eleven"), "--out", path("blinded")}, owner);
        const Json blinded = jsonIn(path("blinded/results.json"));
        QCOMPARE(blinded["conditions"].size(), std::size_t(11));
        QVERIFY(bytesIn(path("blinded/index.html")).contains("K11"));
        for (const char* word : {"own_program", "\"mine\"", "python3"})
            QVERIFY2(!QByteArray::fromStdString(blinded.dump()).contains(word), word);

        mustRun({"unblind", path("eleven"), "--who", "tester", "--why", "test"}, owner);
        mustRun({"report", path("eleven"), "--out", path("open")});
        QVERIFY(bytesIn(path("open/index.html")).contains("The images of condition mine come from python3 (SHA-256 "));
        QVERIFY(bytesIn(path("open/index.html")).contains(" with own_program.py (SHA-256 "));
        const Json results = jsonIn(path("open/results.json"));
        for (const Json& condition : results["conditions"]) {
            const auto id = condition.get<std::string>();
            QVERIFY(results["questions"]["Q2"][id]["mean"].is_number() && results["questions"]["Q1"][id]["trials"] == 70);
        }
        QCOMPARE(results["conditions"][10].get<std::string>(), std::string("mine"));
        QCOMPARE(results["claims"][0]["a"].get<std::string>(), std::string("mine"));
    }

    void theStudyRecordsTheProgramAndWhatItGave()
    {
        const QString good = program("record", "shift 2\n" + QByteArray(plainImage));
        const auto made =
            newStudy("record", "small.json", {"--program", "mine=" + good + " 'a word' *", "--program-seconds", "99"});
        QVERIFY2(made.exitCode == 0, qPrintable(made.err));
        QVERIFY2(made.err.contains("the image of F01 under mine has one level"), qPrintable(made.err));
        mustRun({"export", path("record"), "--out", path("record-blinded"), "--format", "json"});
        QVERIFY(!jsonIn(path("record-blinded/export.json"))["made_with"].contains("programs"));
        mustRun({"unblind", path("record"), "--who", "tester", "--why", "test"});
        mustRun({"export", path("record"), "--out", path("record-export"), "--format", "json"});
        const Json used = jsonIn(path("record-export/export.json"))["made_with"]["programs"]["mine"];
        QCOMPARE(used["program"].get<std::string>(), std::string("record"));
        QCOMPARE(QString::fromStdString(used["folder"].get<std::string>()), path("bin"));
        QCOMPARE(used["arguments"].dump(), std::string(R"(["a word","*"])"));
        QCOMPARE(used["sha256"].get<std::string>(), protocols::sha256(bytesIn(good).toStdString()));
        QCOMPARE(used["seconds_at_most"].get<int>(), 99);
        std::string images;
        for (int k = 0; k < 5; ++k) images += "P5\n1280 800\n255\n" + std::string(1024000, 'a');
        QCOMPARE(used["images_sha256"].get<std::string>(), protocols::sha256(images));
        mustRun({"export", path("record"), "--out", path("record-set"), "--format", "psych-ds"});
        QVERIFY(bytesIn(path("record-set/README.md")).contains("condition mine"));
        mustRun({"export", path("record"), "--out", path("record-public"), "--format", "psych-ds", "--public", "--author", "A"});
        for (const char* file : {"README.md", "dataset_description.json"})
            QVERIFY2(!bytesIn(path("record-public/") + file).contains("condition mine"), file);
    }

    void scriptsOfRecordedSessionsAreReplayed()
    {
        const QString good = program("plain", plainImage);
        for (const char* study : {"first", "second"})
            QVERIFY(newStudy(study, "small.json", {"--program", "mine=" + good}).exitCode == 0);
        mustRun({"simulate", path("first")});
        mustRun({"unblind", path("first"), "--who", "tester", "--why", "test"});
        mustRun({"export", path("first"), "--out", path("scripts"), "--format", "script"});
        const QString script = path("scripts/SIM01.json");
        QVERIFY2(bytesIn(script).contains("\"mine\""), qPrintable(QDir(path("scripts")).entryList().join(' ')));
        mustRun({"replay", path("second"), script});

        // A condition that is misspelt is found before the first answer.
        write("misspelt.json", bytesIn(script).replace("\"mine\"", "\"mien\"").replace("SIM01", "SIM09"));
        const auto refused = runProgram({"replay", path("second"), path("misspelt.json")});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("unknown condition 'mien'; expected a condition of the study: h, mine"),
                 qPrintable(refused.err));
        QVERIFY(!mustRun({"study", "status", path("second")}).out.contains("SIM09"));
    }

    void aProgramSeesNeitherSecretsNorAShell()
    {
        const QString script =
            program("see", "env > '" + path("seen.env").toUtf8() + "'\npwd > '" + path("seen.pwd").toUtf8() +
                               "'\nprintf '%s\\n' \"$@\" > '" + path("seen.words").toUtf8() + "'\nhead -c 2 \"$4\" > '" +
                               path("seen.photo").toUtf8() + "'\nshift 3\n" + plainImage);
        const auto made = newStudy("see", "small.json", {"--program", "mine=" + script + " '*' \"$HOME; true\" `id`"},
                                   {"VIS2HAP_PASSPHRASE=correct horse", "SOMETHING=else"});
        QVERIFY2(made.exitCode == 0, qPrintable(made.err));
        const QList<QByteArray> words = bytesIn(path("seen.words")).split('\n');
        QCOMPARE(words.mid(0, 3), QList<QByteArray>({"*", "$HOME; true", "`id`"}));
        QVERIFY(words[3].endsWith("/photograph.png") && words[4].endsWith("/image.png"));
        QStringList names;
        for (const QByteArray& line : bytesIn(path("seen.env")).split('\n')) names << QString(line).section('=', 0, 0);
        for (const char* known : {"", "PATH", "HOME", "LANG", "TMPDIR", "VIS2HAP_MM_PER_PIXEL", "PWD", "OLDPWD", "SHLVL", "_"})
            names.removeAll(known);
        QVERIFY2(names.isEmpty(), qPrintable(names.join(' ')));
        QVERIFY(bytesIn(path("seen.env")).contains("VIS2HAP_MM_PER_PIXEL=0."));
        QCOMPARE(QString(bytesIn(path("seen.pwd"))).trimmed(), QDir::currentPath());
        QCOMPARE(bytesIn(path("seen.photo")), QByteArray("\x89P"));
    }

    void programsThatFailAreNamedAndNothingIsMade_data()
    {
        QTest::addColumn<QByteArray>("body");
        QTest::addColumn<QString>("words");
        const auto row = [](const char* name, const char* body, const char* words) {
            QTest::newRow(name) << QByteArray(body) << QString(words);
        };
        row("hangs with children", "setsid sleep 298.7 &\nsleep 298.7", "did not end within 2 s and was stopped");
        row("writes nothing", "echo fine", "wrote no image");
        row("writes too much", "head -c 70000000 /dev/zero > \"$2\"; exit 0", "wrote 64 MiB or more into the image");
        row("says too much", "head -c 70000000 /dev/zero; exit 0", "wrote 64 MiB or more into standard output");
        row("another size", "printf 'P5\\n2 2\\n255\\nabcd' > \"$2\"",
            "wrote an image of 2 x 2 pixels, 1 channel of 8 bits; expected 1280 x 800 pixels");
        row("colour", "cp \"$1\" \"$2\"", "3 channels of 8 bits");
        row("no image", "echo hello > \"$2\"", "wrote a file that is neither PNG nor binary PGM");
        row("a damaged image", "printf 'P5\\n1280 800\\n255\\nabcd' > \"$2\"", "wrote a damaged PGM");
        row("a folder", "mkdir \"$2\"", "wrote no image");
        row("a link", "ln -s \"$1\" \"$2\"", "wrote no image");
        row("a pipe", "mkfifo \"$2\"", "wrote no image");
        row("killed", "kill -9 $$", "was ended by signal 9");
        row("memory", "python3 -c 'bytearray(9 << 30)'", "MemoryError");
    }

    void programsThatFailAreNamedAndNothingIsMade()
    {
        QFETCH(QByteArray, body);
        QFETCH(QString, words);
        QElapsedTimer time;
        time.start();
        const QString script = program("bad", body + "\n");
        const bool hangs = body.contains("sleep");
        const QString seconds = hangs ? "2" : "60";  // a busy machine must not stop the others
        const auto made = newStudy("never", "small.json", {"--program", "mine=" + script, "--program-seconds", seconds});
        QVERIFY2(!hangs || time.elapsed() < 60000, qPrintable(QString::number(time.elapsed())));
        QCOMPARE(made.exitCode, 1);
        QVERIFY2(made.messages().size() == 1 && made.err.contains("fabric F01 (1 of 5): the program of condition 'mine' ") &&
                     made.err.contains(words),
                 qPrintable(made.err));
        nothingIsLeft();
        QVERIFY(!runsWith("298.7"));
    }

    void aProgramThatFailsAtTheThirdFabricSaysWhere()
    {
        const QByteArray counter = path("counter").toUtf8();
        const QString script =
            program("third",
                    "echo x >> '" + counter + "'\nif [ $(wc -l < '" + counter +
                        "') = 3 ]; then echo first >&2; printf 'no \\033[31mred\\377 thread\\n\\n' >&2; echo late; exit 7; fi\n" +
                        plainImage);
        const auto made = newStudy("never", "small.json", {"--program", "mine=" + script});
        QCOMPARE(made.exitCode, 1);
        QVERIFY2(made.messages().size() == 1 &&
                     made.err.contains("fabric F03 (3 of 5): the program of condition 'mine' ended with status 7: "
                                       "no \\x1b[31mred? thread"),
                 qPrintable(made.err));
        QVERIFY2(made.err.contains("/F03/visual/"), qPrintable(made.err));
        QVERIFY(!made.err.contains('\x1b'));
        nothingIsLeft();
    }

    void callsThatDoNotFitTheProtocolAreRefused_data()
    {
        QTest::addColumn<QStringList>("programs");
        QTest::addColumn<QString>("words");
        const QString good = program("plain", plainImage);
        QTest::newRow("none") << QStringList() << "condition 'mine' comes from a program, and none is named";
        QTest::newRow("unknown id") << QStringList{"mine=" + good, "mien=" + good} << "small.json has no condition 'mien'";
        QTest::newRow("twice") << QStringList{"mine=" + good, "mine=" + good} << "condition 'mine' has two programs";
        QTest::newRow("one of the nine") << QStringList{"mine=" + good, "h=" + good} << "'h' is a condition of the program";
        QTest::newRow("missing") << QStringList{"mine=nowhere-to-be-found"}
                                 << "the program 'nowhere-to-be-found' is missing; expected a program in a folder of PATH";
        QTest::newRow("missing path") << QStringList{"mine=" + path("nowhere")} << "is missing; expected an executable file";
        QTest::newRow("not executable") << QStringList{"mine=" + path("small.json")} << "cannot be executed";
        QTest::newRow("a folder") << QStringList{"mine=" + path("tmp")} << "cannot be executed";
        QTest::newRow("no command") << QStringList{"mine="} << "names no program";
        QTest::newRow("blanks") << QStringList{"mine=  "} << "names no program";
        QTest::newRow("no id") << QStringList{good} << "names no condition";
        QTest::newRow("open quote") << QStringList{"mine=" + good + " \"a b"} << "a quote \" is not closed";
    }

    void callsThatDoNotFitTheProtocolAreRefused()
    {
        QFETCH(QStringList, programs);
        QFETCH(QString, words);
        QStringList options;
        for (const QString& one : programs) options << "--program" << one;
        const auto made = newStudy("never", "small.json", options);
        QCOMPARE(made.exitCode, 2);
        QVERIFY2(made.messages().size() == 1 && made.err.contains(words), qPrintable(made.err));
        nothingIsLeft();
    }

    void aScriptWithoutAnInterpreterIsExplained()
    {
        QDir().mkpath(path("bin"));
        write("bin/bare", QByteArray("\x01\x02 no program"));
        QFile::setPermissions(path("bin/bare"), QFile::ReadOwner | QFile::ExeOwner);
        const auto made = newStudy("never", "small.json", {"--program", "mine=" + path("bin/bare")});
        QCOMPARE(made.exitCode, 2);
        QVERIFY2(
            made.messages().size() == 1 && made.err.contains("Exec format error") && made.err.contains("begin a script with #!"),
            qPrintable(made.err));
        nothingIsLeft();
    }

    void readyImagesTakeNoProgramAndNoneTakesBoth()
    {
        const QString good = program("plain", plainImage);
        write("images.json", QByteArray(smallText).replace("\"program\": true", "\"images\": \"ready\""));
        const auto made = newStudy("never", "images.json", {"--program", "mine=" + good});
        QVERIFY2(made.exitCode == 2 && made.err.contains("condition 'mine' has ready images in "), qPrintable(made.err));
        write("both.json", QByteArray(smallText).replace("\"program\": true", "\"program\": true, \"images\": \"ready\""));
        const auto both = runProgram({"protocol", "check", path("both.json")});
        QVERIFY2(both.exitCode == 2 && both.out.contains("has both of 'images' and 'program', expected one of them"),
                 qPrintable(both.out));
        write("command.json", QByteArray(smallText).replace("\"program\": true", "\"program\": \"" + good.toUtf8() + "\""));
        const auto command = runProgram({"protocol", "check", path("command.json")});
        QVERIFY2(command.exitCode == 2 && command.out.contains("study new --program ID=COMMAND"), qPrintable(command.out));
    }

    void checkAndShowRunNothing()
    {
        for (const char* command : {"check", "show"}) {
            const auto run = runProgram({"protocol", command, path("small.json")});
            QVERIFY2(run.exitCode == 0, qPrintable(run.err));
        }
        const auto shown = mustRun({"protocol", "show", path("small.json")});
        QVERIFY2(shown.out.contains("--program mine=COMMAND"), qPrintable(shown.out));
    }

private:
    enum class Key { Open, Sealed };

    QString path(const QString& name) const { return m_folder.filePath(name); }

    void write(const QString& name, const QByteArray& text) const
    {
        std::ofstream(path(name).toStdString()) << text.toStdString();
    }

    /// An executable shell script.
    QString program(const QString& name, const QByteArray& body) const
    {
        QDir().mkpath(path("bin"));
        write("bin/" + name, "#!/bin/sh\n" + body);
        QFile::setPermissions(path("bin/" + name), QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
        return path("bin/" + name);
    }

    support::ProgramResult newStudy(const QString& study, const QString& protocol, const QStringList& options,
                                    const QStringList& environment = {}, Key key = Key::Open) const
    {
        QStringList call{"study",  "new", path(study),  "--dataset", path("fabrics"), "--protocol", path(protocol),
                         "--seed", "1",   "--key-seed", "2"};
        if (key == Key::Open) call << "--no-passphrase";
        return runProgram(call + options, environment + QStringList{"TMPDIR=" + path("tmp")});
    }

    void nothingIsLeft() const
    {
        QVERIFY(!QDir(path("never")).exists());
        QVERIFY(QDir(path("tmp")).isEmpty(QDir::AllEntries | QDir::Hidden | QDir::System | QDir::NoDotAndDotDot));
        QVERIFY(QDir(m_folder.path()).entryList({".*"}, QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).isEmpty());
    }

    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(OwnProgramTest)
#include "own_program_test.moc"
