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
        const protocols::Error fault = protocols::badInput({"bad id \x1b]0;title\a", "file\nname", "", ""});
        QCOMPARE(std::string(fault.what()), std::string("file name: bad id \\x1b]0;title\\x07"));
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
