// The head of the log outside the study: on printed pages, and signed.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <cstring>

#include "tests/study/commands/evidence_study.h"
#include "tests/support/program.h"

using nlohmann::json;
using support::mustRun;
using support::runProgram;
using tests::evidence::bytesOf;
using tests::evidence::headIn;
using tests::support::OpenSession;

class SignedHeadTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    QString at(const QString& name) const { return m_place.filePath(name); }

    QString playedStudy()
    {
        const QString study = at(QString("study%1").arg(++m_studies));
        tests::evidence::playStudy(study.toStdString());
        return study;
    }

private Q_SLOTS:
    void printedPagesCarryTheHead()
    {
        const QString study = playedStudy();
        mustRun({"study", "sheets", study, "--out", at("pages")});
        const QString head = headIn(study), number = head.left(head.indexOf(':')), brief = head.left(number.size() + 17);
        const QString command = "vis2hap verify " + QDir(study).dirName() + " --against " + brief;
        for (const char* page : {"labels.html", "preparation.html", "session.html", "scale-card.html"}) {
            const QString text = bytesOf(at("pages/") + page);
            QVERIFY2(text.contains("<b>" + brief + "</b> (" + number + " entries)") && text.contains(command), page);
            QVERIFY2(!text.contains(head), page);
        }
        QVERIFY(bytesOf(at("pages/session.html")).contains("<th>head of the log</th>"));
        QVERIFY(mustRun({"verify", study, "--against", brief}).out.contains("the log contains the given head"));
    }

    void printedPagesFollowTheirLanguage()
    {
        const QString study = playedStudy(), head = headIn(study), number = head.left(head.indexOf(':'));
        mustRun({"study", "sheets", study, "--out", at("sheets"), "--language", "zh_CN"});
        for (const char* page : {"labels.html", "preparation.html", "session.html"}) {
            const QString text = bytesOf(at("sheets/") + page);
            QVERIFY2(text.contains("<html lang=\"zh\">") && text.contains("</b>（" + number + "条记录）。校验："), page);
        }
        QVERIFY(bytesOf(at("sheets/labels.html")).contains("布样标签</h1>"));
        QVERIFY(bytesOf(at("sheets/scale-card.html")).contains("<html lang=\"en\">"));  // the card is for participants
    }

    /// ü is one character on one keyboard, and u with two dots on another; Windows writes files in UTF-16 or with a mark.
    void aPassphraseOpensHoweverItsLettersAreWritten()
    {
        const QString study = playedStudy(), key = at("sealed");
        const auto words = [&](const QByteArray& bytes) {
            QFile file(at("words.txt"));
            if (file.open(QIODevice::WriteOnly)) file.write(bytes);
            return file.fileName();
        };
        mustRun({"study", "signing-key", "--out", key, "--passphrase-file", words("Schl\xC3\xBCssel \xE4\xB8\x8A\r\n")});
        const auto opens = [&](const QByteArray& bytes, int number) {
            const auto run = runProgram({"study", "sign", study, "--key", key, "--out", at(QString("head%1.txt").arg(number)),
                                         "--passphrase-file", words(bytes)});
            return run.exitCode == 0;
        };
        const QString text = QString::fromUtf8("Schl\xC3\xBCssel \xE4\xB8\x8A");
        QVERIFY(opens(text.toUtf8(), 1));
        QVERIFY(opens(text.normalized(QString::NormalizationForm_D).toUtf8() + "\nsecond line", 2));
        QByteArray wide("\xFF\xFE", 2);
        for (const QChar c : text + "\r\n")
            wide += QByteArray(1, char(c.unicode() & 0xFF)) + QByteArray(1, char(c.unicode() >> 8));
        QVERIFY(opens(wide, 3));
        QVERIFY(!opens("Schlussel \xE4\xB8\x8A", 4) && !opens("Schl\xC3\xBCssel", 5));
        QVERIFY(opens(text.toUtf8() + "\rsecond line", 6));  // of an old Macintosh
        const auto picture = runProgram({"study", "sign", study, "--key", key, "--out", at("head7.txt"), "--passphrase-file",
                                         words(QByteArray(2 << 20, '\xE4'))});
        QVERIFY2(picture.exitCode == 2 && picture.messages().size() == 1 && picture.err.contains("words.txt"),
                 qPrintable(picture.err));
    }

    /// Half an hour of work can stand in a file of one kilobyte.
    void aKeyThatAsksForTooMuchWorkIsRefused()
    {
        const QString study = playedStudy(), key = at("heavy");
        mustRun({"study", "signing-key", "--out", key}, {"VIS2HAP_PASSPHRASE=four plain words"});
        json sealed = json::parse(bytesOf(key).toStdString());
        sealed["passes"] = 16;
        sealed["memory_bytes"] = std::int64_t{1} << 30;
        QFile file(key);
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(QByteArray::fromStdString(sealed.dump()));
        file.close();
        const auto refused =
            runProgram({"study", "sign", study, "--key", key, "--out", at("heavy.txt")}, {"VIS2HAP_PASSPHRASE=four plain words"});
        QVERIFY2(refused.exitCode == 2 && refused.err.contains("ask for too much work"), qPrintable(refused.err));
    }

    /// $(cat words.txt) leaves the carriage return of a file from Windows.
    void aPassphraseInAVariableEndsWithItsLastLetter()
    {
        const QString study = playedStudy(), key = at("from-variable");
        mustRun({"study", "signing-key", "--out", key}, {"VIS2HAP_PASSPHRASE=four plain words\r"});
        for (const char* end : {"", "\r", "\r\n"})
            mustRun({"study", "sign", study, "--key", key, "--out", at(QString("variable%1.txt").arg(std::strlen(end)))},
                    {QString("VIS2HAP_PASSPHRASE=four plain words") + end});
        const auto refused = runProgram({"study", "signing-key", "--out", at("other")}, {"VIS2HAP_PASSPHRASE=four\tplain words"});
        QVERIFY2(refused.exitCode == 2 && refused.err.contains("control character"), qPrintable(refused.err));
    }

    /// "8 characters or more" are characters, not bytes.
    void aPassphraseIsCountedInCharacters()
    {
        for (const auto& [words, isLongEnough] :
             {std::pair{"ääää", false}, {"ääääääää", true}, {"绿色的羊毛", false}, {"绿色的羊毛和丝绸", true}, {"", false}}) {
            const auto made = runProgram({"study", "signing-key", "--out", at(QString("counted-%1").arg(words))},
                                         {QString("VIS2HAP_PASSPHRASE=%1").arg(words)});
            QVERIFY2(made.exitCode == (isLongEnough ? 0 : 2), qPrintable(made.err));
            QVERIFY2(isLongEnough || made.err.contains("8 characters or more"), qPrintable(made.err));
        }
    }

    void aSignedHeadIsChecked()
    {
        const QString study = playedStudy(), key = at("lab"), statement = at("head.txt");
        mustRun({"study", "signing-key", "--out", key, "--no-passphrase"});
        mustRun({"study", "sign", study, "--key", key, "--out", statement});
        const QString head = headIn(study);
        QVERIFY(bytesOf(statement).contains("head: " + head + "\nentries: " + head.left(head.indexOf(':')) + "\ntime: "));
        const QStringList check{"verify", study, "--against", statement, "--public-key", key + ".pub"};
        auto run = mustRun(check);
        QVERIFY2(run.out.contains("the signature is that of the public key") && run.out.contains("does not prove"),
                 qPrintable(run.out));
        const json result = json::parse(mustRun(check + QStringList{"--json"}).out.toStdString());
        QVERIFY(result["signature"]["valid"].get<bool>() && result["against"][0]["contained"].get<bool>());

        // Later entries do not matter.
        mustRun({"unblind", study, "--who", "M", "--why", "done"});
        mustRun(check);

        run = mustRun({"verify", study, "--against", statement});
        QVERIFY2(run.out.contains("its signature was not checked"), qPrintable(run.out));

        mustRun({"study", "signing-key", "--out", at("other"), "--no-passphrase"});
        run = runProgram({"verify", study, "--against", statement, "--public-key", at("other.pub")});
        QCOMPARE(run.exitCode, 1);
        QVERIFY2(run.out.contains("signed with another key") && run.out.contains(": 1 fault "), qPrintable(run.out));

        QFile altered(at("altered.txt"));
        QVERIFY(altered.open(QIODevice::WriteOnly));
        altered.write(bytesOf(statement).replace("time: 2", "time: 1").toUtf8());
        altered.close();
        run = runProgram({"verify", study, "--against", altered.fileName(), "--public-key", key + ".pub"});
        QCOMPARE(run.exitCode, 1);
        QVERIFY2(run.out.contains("altered after it was signed") && run.out.contains(": 1 fault "), qPrintable(run.out));

        run = runProgram({"verify", study, "--public-key", key + ".pub"});
        QCOMPARE(run.exitCode, 2);
        QVERIFY2(run.err.contains("there is no signature to check"), qPrintable(run.err));
        run = runProgram({"verify", study, "--against", statement, "--public-key", key});
        QCOMPARE(run.exitCode, 2);
        QVERIFY2(run.err.contains("no public key of Ed25519"), qPrintable(run.err));
    }

    /// The database of an earlier day is put back: the signature holds, and the log lacks the head.
    void aRolledBackStudyLacksTheSignedHead()
    {
        const QString study = at("rolled"), statement = at("rolled.txt");
        tests::support::buildStudy(study.toStdString());
        OpenSession({study.toStdString()}, "P1").playUntilAnswers(2);
        QVERIFY(QFile::copy(study + "/study.db", at("earlier.db")));
        OpenSession({study.toStdString()}, "P1").playUntilAnswers(5);
        mustRun({"study", "signing-key", "--out", at("key"), "--no-passphrase"});
        mustRun({"study", "sign", study, "--key", at("key"), "--out", statement});
        for (const char* file : {"/study.db", "/study.db-wal", "/study.db-shm"}) QFile::remove(study + file);
        QVERIFY(QFile::copy(at("earlier.db"), study + "/study.db"));
        const auto run = runProgram({"verify", study, "--against", statement, "--public-key", at("key.pub")});
        QCOMPARE(run.exitCode, 1);
        QVERIFY2(run.out.contains("entries were cut off, or an earlier database was put back"), qPrintable(run.out));
    }

    /// A key that was pieced together would sign under a public key that is not its own.
    void aKeyWhosePartsDisagreeIsRefused()
    {
        const QString study = playedStudy(), key = at("whole"), changed = at("changed");
        mustRun({"study", "signing-key", "--out", key, "--no-passphrase"});
        const auto refusalWith = [&](const char* field, const std::string& value) {
            json document = tests::evidence::jsonOf(key);
            document[field] = value;
            QFile file(changed);
            if (file.open(QIODevice::WriteOnly)) file.write(QByteArray::fromStdString(document.dump()));
            file.close();
            const auto run = runProgram({"study", "sign", study, "--key", changed, "--out", at("never.txt")});
            return run.exitCode == 2 ? run.err : QString("exit %1").arg(run.exitCode);
        };
        const QString other = refusalWith("public_key", std::string(64, '0'));
        QVERIFY2(other.contains("is not that of its \"key\""), qPrintable(other));
        const QString algorithm = refusalWith("algorithm", "RSA");
        QVERIFY2(algorithm.contains("for another algorithm") && algorithm.contains("Ed25519"), qPrintable(algorithm));
        QVERIFY(!QFile::exists(at("never.txt")));
    }

    /// The name of the study stands in the statement, too.
    void aNameThatLooksLikeAHeadIsNone()
    {
        const QString study = at("named"), statement = at("named.txt");
        const std::string name = "Batch 7:0123456789abcdef";
        std::string protocol = tests::evidence::askingProtocol;
        protocol.replace(protocol.find("A <study> of touch"), std::strlen("A <study> of touch"), name);
        tests::evidence::playStudy(study.toStdString(), protocol);
        mustRun({"study", "signing-key", "--out", at("key4"), "--no-passphrase"});
        mustRun({"study", "sign", study, "--key", at("key4"), "--out", statement});
        QVERIFY(bytesOf(statement).contains("study: " + QString::fromStdString(name)));
        for (const QStringList& key : {QStringList{"--public-key", at("key4.pub")}, QStringList{}}) {
            const json result =
                json::parse(mustRun(QStringList{"verify", study, "--against", statement, "--json"} + key).out.toStdString());
            QCOMPARE(result["against"].size(), std::size_t{1});
            QCOMPARE(QString::fromStdString(result["against"][0]["head"].get<std::string>()), headIn(study));
        }
    }

    void onlySoundStudiesAreSigned()
    {
        const QString study = playedStudy();
        mustRun({"study", "signing-key", "--out", at("key3"), "--no-passphrase"});
        QCOMPARE(runProgram({"study", "signing-key", "--out", at("key3"), "--no-passphrase"}).exitCode, 2);
        QCOMPARE(QFile(at("key3")).permissions() & (QFile::ReadGroup | QFile::ReadOther), QFile::Permissions());
        auto run = runProgram({"study", "sign", study, "--key", at("key3"), "--out", study + "/head.txt"});
        QCOMPARE(run.exitCode, 2);
        QVERIFY2(run.err.contains("would lie in the study folder"), qPrintable(run.err));
        QVERIFY(QFile::copy(at("key3.pub"), study + "/stray"));
        run = runProgram({"study", "sign", study, "--key", at("key3"), "--out", at("unsound.txt")});
        QCOMPARE(run.exitCode, 1);
        QVERIFY2(run.err.contains("the study is not sound: stray"), qPrintable(run.err));
        QVERIFY(!QFile::exists(at("unsound.txt")));
    }
};

QTEST_GUILESS_MAIN(SignedHeadTest)
#include "signed_head_test.moc"
