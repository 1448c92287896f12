#include "protocols/files/sha256.h"

#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "protocols/files/errors.h"

class Sha256Test : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void matchesTheExamplesOfTheStandard_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("digest");
        // printf '%s' TEXT | sha256sum
        QTest::newRow("empty") << QByteArray() << "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        QTest::newRow("abc") << QByteArray("abc") << "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        QTest::newRow("a million a") << QByteArray(1'000'000, 'a')
                                     << "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0";
    }

    void matchesTheExamplesOfTheStandard()
    {
        QFETCH(const QByteArray, text);
        QFETCH(const QString, digest);
        QCOMPARE(QString::fromStdString(protocols::sha256(text.toStdString())), digest);
        const QTemporaryDir folder;
        const std::filesystem::path file = folder.filePath("bytes").toStdString();
        std::ofstream(file, std::ios::binary) << text.toStdString();
        QCOMPARE(QString::fromStdString(protocols::sha256OfFile(file)), digest);
    }

    void missingFileIsBadInput()
    {
        try {
            protocols::sha256OfFile("/nowhere/at/all");
            QFAIL("a missing file has a hash");
        } catch (const protocols::Error& error) {
            QCOMPARE(error.exitCode(), protocols::ExitCode::BadInput);
            QVERIFY(QString(error.what()).contains("/nowhere/at/all"));
        }
    }

    void folderIsNoFile() { QVERIFY_EXCEPTION_THROWN(protocols::sha256OfFile("/"), protocols::Error); }
};

QTEST_GUILESS_MAIN(Sha256Test)
#include "sha256_test.moc"
