#include "protocols/files/safe_text.h"

#include <QTest>
#include <set>
#include <string>

#include "protocols/files/errors.h"

using protocols::fileNameOf;
using protocols::printable;

class SafeTextTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aTerminalIsNotCommanded()
    {
        QCOMPARE(printable("a\x1b[2Jb"), std::string("a\\x1b[2Jb"));
        QCOMPARE(printable("bell\a, delete\x7f"), std::string("bell\\x07, delete\\x7f"));
        QCOMPARE(printable("C1 \xc2\x9b"
                           "31m"),
                 std::string("C1 \\x9b31m"));
        QCOMPARE(printable("two\nlines"), std::string("two lines"));
        QCOMPARE(printable("Größe 触覚 ±0.5"), std::string("Größe 触覚 ±0.5"));
        QCOMPARE(protocols::printableLines("one\x1b[2J\n\ntwo\a\n"), std::string("one\\x1b[2J\n\ntwo\\x07\n"));
        QCOMPARE(protocols::printableLines("one\nlast"), std::string("one\nlast"));
        const protocols::Error fault = protocols::badInput({"bad id \x1b]0;title\a", "file\nname", "", ""});
        QCOMPARE(std::string(fault.what()), std::string("file name: bad id \\x1b]0;title\\x07"));
    }

    void aPathIsOneWordForAShell()
    {
        QCOMPARE(protocols::shellWord("/data/my-study_1.db"), std::string("/data/my-study_1.db"));
        QCOMPARE(protocols::shellWord("Stüdie"), std::string("Stüdie"));
        QCOMPARE(protocols::shellWord("Stüdie mit Leer"), std::string("'Stüdie mit Leer'"));
        QCOMPARE(protocols::shellWord("it's"), std::string("'it'\\''s'"));
        QCOMPARE(protocols::shellWord("a;$(b)"), std::string("'a;$(b)'"));
        QCOMPARE(protocols::shellWord("postgresql://u@h/d?study=x"), std::string("'postgresql://u@h/d?study=x'"));
        QCOMPARE(protocols::shellWord(""), std::string("''"));
    }

    void anIdNamesAFileInItsFolder()
    {
        QCOMPARE(fileNameOf("P01"), std::string("P01"));
        QCOMPARE(fileNameOf("../victim"), std::string("%2E.%2Fvictim"));
        QCOMPARE(fileNameOf("/etc/passwd"), std::string("%2Fetc%2Fpasswd"));
        QCOMPARE(fileNameOf("."), std::string("%2E"));
        QCOMPARE(fileNameOf(""), std::string("%"));
        const std::set<std::string> names{fileNameOf("a/b"), fileNameOf("a%2Fb"), fileNameOf("a_b"), fileNameOf("ab")};
        QCOMPARE(names.size(), std::size_t{4});
    }
};

QTEST_GUILESS_MAIN(SafeTextTest)
#include "safe_text_test.moc"
