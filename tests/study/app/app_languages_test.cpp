// The window in each of its languages: no English is left on any page, no text is cut, and a catalogue that cannot be used is
// refused in one line.
#include <QAbstractButton>
#include <QComboBox>
#include <QDataStream>
#include <QDir>
#include <QFile>
#include <QHeaderView>
#include <QLabel>
#include <QLibraryInfo>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QRegularExpression>
#include <QTest>
#include <QTreeWidget>

#include "protocols/files/errors.h"
#include "protocols/usual_texts.h"
#include "study/app/language/app_text.h"
#include "study/app/language/fonts.h"
#include "study/app/language/language.h"
#include "study/app/pages/start_page.h"
#include "study/app/state/appearance.h"
#include "study/app/state/rating_text.h"
#include "tests/study/app/every_page.h"
#include "tests/study/app/page_measures.h"
#include "tests/support/program.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;

namespace {

constexpr const char* program = "vis2hap 0.6.0";

/// Everything that a page shows or a screen reader speaks, without what was typed.
QStringList textsIn(const QWidget& window)
{
    QStringList texts{window.windowTitle()};
    for (const QWidget* widget : window.findChildren<QWidget*>()) {
        if (!widget->isVisible()) continue;
        texts << widget->accessibleName() << widget->toolTip();
        if (const auto* label = qobject_cast<const QLabel*>(widget)) texts << label->text();
        if (const auto* button = qobject_cast<const QAbstractButton*>(widget)) texts << button->text();
        if (const auto* line = qobject_cast<const QLineEdit*>(widget)) texts << line->placeholderText();
        if (const auto* field = qobject_cast<const QPlainTextEdit*>(widget)) texts << field->placeholderText();
        if (const auto* list = qobject_cast<const QComboBox*>(widget);
            list && list->objectName() != "languageList" && list->objectName() != "participantsLanguageList")
            for (int place = 0; place < list->count(); ++place) texts << list->itemText(place);
        if (const auto* tree = qobject_cast<const QTreeWidget*>(widget)) {
            for (int column = 0; column < tree->columnCount(); ++column) {
                texts << tree->headerItem()->text(column);
                for (int row = 0; row < tree->topLevelItemCount(); ++row) texts << tree->topLevelItem(row)->text(column);
            }
        }
    }
    texts.removeAll(QString());
    texts.removeDuplicates();
    return texts;
}

/// Names that the tests give to what a laboratory would name in its own language: fabrics, folders, displays, the errors of
/// files.
QString withoutNames(QString text)
{
    static const QRegularExpression names(QStringLiteral(
        "/[^ ,;:]*|[a-z]+\\.(?:db|json)\\b|`[^`]*`|--[a-z-]+|vis2hap [a-z]+( [a-z]+)?|Vis2Hap|Fifteen fabrics|Linen|Felt|plain "
        "weave|felt, from the "
        "museum|is truncated|display: the display does not answer[;；] ?plug it in|known fabric [0-9]|One felt sticky, the "
        "others "
        "dry|the station key is missing|the file of "
        "the study|restore it"));
    return text.remove(names);
}

/// Words that only English has among the languages of the window.
bool looksEnglish(const QString& text)
{
    static const QRegularExpression words(
        QStringLiteral("\\b(the|is|are|of|and|to|not|this|that|with|for|from|press|type|has|have|or|no|yes|it|you|your|by|at|"
                       "participant|fabric|answer|store|again|study|session|display|scale|piece|please)\\b"),
        QRegularExpression::CaseInsensitiveOption);
    return words.match(withoutNames(text)).hasMatch();
}

/// A sentence in a sentence can bring a second full stop.
bool hasTwoFullStops(const QString& text) { return text.contains(QLatin1String("..")) || text.contains(QStringLiteral("。。")); }

/// Words that German has, too.
QString withoutSharedWords(QString text) { return text.remove(QRegularExpression(QStringLiteral("\\b(Display|Displays)\\b"))); }

}  // namespace

class AppLanguagesTest : public tests::EveryPage {
    Q_OBJECT

private:
    /// A catalogue of three texts, made by lrelease.
    QString catalogueFor(const QString& version, const QString& language = "de")
    {
        const QString ts = filePath("own.ts"), qm = filePath("own-" + version + "-" + language + ".qm");
        QFile file(ts);
        if (!file.open(QIODevice::WriteOnly)) return {};
        file.write(QStringLiteral("<?xml version=\"1.0\"?><!DOCTYPE TS><TS version=\"2.1\" language=\"%1\"><context>"
                                  "<name>study::app::Catalogue</name>"
                                  "<message><source>name of the language</source><translation>Platt</translation></message>"
                                  "<message><source>reviewer</source><translation>Fiete</translation></message>"
                                  "<message><source>version of the program</source><translation>%2</translation></message>"
                                  "</context></TS>")
                       .arg(language, version)
                       .toUtf8());
        file.close();
        QProcess::execute(QLibraryInfo::path(QLibraryInfo::BinariesPath) + "/lrelease", {"-silent", ts, "-qm", qm});
        return qm;
    }

    /// What the program says, where it must not begin.
    static QString refusalOf(const QString& wanted)
    {
        LanguageInUse language(program);
        try {
            language.use(wanted);
        } catch (const protocols::Error& fault) {
            return fault.what();
        }
        return {};
    }

private Q_SLOTS:
    void init() { m_language = "en"; }
    void cleanup() { applyAppearance({}, m_font); }

    void everyPageIsInTheLanguage_data()
    {
        QTest::addColumn<QString>("tag");
        for (const Language& one : shippedLanguages())
            if (one.tag != "en") QTest::newRow(qPrintable(one.tag)) << one.tag;
        QVERIFY(shippedLanguages().size() > 1);
    }
    void everyPageIsInTheLanguage()
    {
        QFETCH(const QString, tag);
        LanguageInUse language(program);
        language.use(tag);
        m_language = languageOfWindow().toStdString();
        QVERIFY(protocols::hasUsualTexts(m_language) && m_language != "en");
        QStringList english;
        int pages = 0;
        visitPages([&](QWidget& window, const char* page) {
            ++pages;
            for (const QString& text : textsIn(window))
                if (looksEnglish(withoutSharedWords(text)) || hasTwoFullStops(text))
                    english << QString::fromLatin1(page) + ": " + text;
        });
        QVERIFY(pages > 35);
        QVERIFY2(english.isEmpty(), qPrintable(english.join('\n')));
    }

    void noTextIsCut_data()
    {
        QTest::addColumn<QString>("tag");
        QTest::addColumn<int>("percent");
        for (const Language& one : shippedLanguages())
            if (one.tag != "en")
                for (const int percent : {100, 200})
                    QTest::addRow("%s, %d %%", qPrintable(one.tag), percent) << one.tag << percent;
    }
    void noTextIsCut()
    {
        QFETCH(const QString, tag);
        QFETCH(const int, percent);
        LanguageInUse language(program);
        language.use(tag);
        m_language = languageOfWindow().toStdString();
        QStringList cut;
        visitPages([&](QWidget& window, const char* page) {
            auto* main = qobject_cast<MainWindow*>(&window);
            if (main)
                main->setAppearance({Theme::Light, percent});
            else
                applyAppearance({Theme::Light, percent}, m_font, QSize(1100, 750));
            window.resize(1100, 750);
            const auto faults = [&] { return tests::cutTextsIn(window) + tests::wideAreasIn(window); };
            if (!QTest::qWaitFor([&] { return faults().isEmpty(); }, 2000))
                cut << QString::fromLatin1(page) + ": " + faults().join(", ");
        });
        QVERIFY2(cut.isEmpty(), qPrintable(cut.join('\n')));
    }

    void englishIsFound()
    {
        QVERIFY(looksEnglish("Store the answer (Enter)"));
        QVERIFY(looksEnglish("finished: no answer"));
        QVERIFY(!looksEnglish("Antwort speichern (Enter)"));
        QVERIFY(!looksEnglish("保存答案 (Enter)"));
        QVERIFY(!looksEnglish("Fifteen fabrics: /tmp/the/study"));
    }

    void languagesAreKnownByTheirTags()
    {
        for (const char* tag : {"de", "de-CH", "de_AT", "de_DE.UTF-8"}) QCOMPARE(shippedTagFor(tag), QString("de"));
        for (const char* tag : {"en", "en-GB", "en_US.UTF-8"}) QCOMPARE(shippedTagFor(tag), QString("en"));
        for (const char* tag : {"zh", "zh-CN", "zh_CN.UTF-8", "zh-Hans", "zh-SG"}) QCOMPARE(shippedTagFor(tag), QString("zh_CN"));
        for (const char* tag : {"zh-Hant", "zh_TW", "zh-HK", "", "C", "POSIX", "xx", "fr", "Deutsch"})
            QVERIFY2(!shippedTagFor(tag), tag);
    }

    void textsFollowTheLanguageAndReturn()
    {
        const auto text = [] { return StartPage::tr("Recent studies"); };
        QCOMPARE(text(), QString("Recent studies"));
        {
            LanguageInUse language(program);
            language.use("de");
            QCOMPARE(text(), QString("Zuletzt geöffnete Studien"));
            QCOMPARE(textOf(protocols::Tenths{54}), QString("5,4"));
            language.use("en");
            QCOMPARE(text(), QString("Recent studies"));
            language.use("de");
        }
        QCOMPARE(text(), QString("Recent studies"));
        QCOMPARE(textOf(protocols::Tenths{54}), QString("5.4"));
    }

    void cataloguesThatCannotBeUsedAreRefused()
    {
        QVERIFY2(refusalOf("xx").contains("there is no catalogue for the language 'xx'; expected one of en, de"),
                 qPrintable(refusalOf("xx")));
        QVERIFY2(refusalOf("/nowhere/x.qm").contains("/nowhere/x.qm: there is no such catalogue"),
                 qPrintable(refusalOf("/nowhere/x.qm")));
        const QString sound = catalogueFor("0.6.3");
        QVERIFY2(refusalOf(sound).isEmpty(), qPrintable(refusalOf(sound)));
        const QString older = refusalOf(catalogueFor("0.5.0"));
        QVERIFY2(older.contains("was made for version 0.5.0; expected a catalogue for version 0.6.0"), qPrintable(older));
        QFile whole(sound);
        QVERIFY(whole.open(QIODevice::ReadOnly));
        const QByteArray content = whole.readAll();
        for (const QByteArray& damaged : {QByteArray(), QByteArray("no catalogue"), content.first(content.size() / 2),
                                          QByteArray(content).replace(content.size() / 3, 40, QByteArray(40, '\xff'))}) {
            QFile file(filePath("damaged.qm"));
            QVERIFY(file.open(QIODevice::WriteOnly) && file.write(damaged) == damaged.size());
            file.close();
            const QString why = refusalOf(file.fileName());
            QVERIFY2(
                why.contains("this is no catalogue of this program, or it is damaged") || why.contains("was made for version"),
                qPrintable(why));
            QVERIFY(!why.contains('\n'));
        }
        // A catalogue that names another file would bring in texts that nobody looked at.
        QByteArray other, length;
        QDataStream ofOther(&other, QIODevice::WriteOnly), ofLength(&length, QIODevice::WriteOnly);
        ofOther << sound;
        ofLength << static_cast<quint32>(other.size());
        QFile linking(filePath("linking.qm"));
        QVERIFY(linking.open(QIODevice::WriteOnly) && linking.write(content + '\x96' + length + other) > 0);
        linking.close();
        QVERIFY2(refusalOf(linking.fileName()).contains("damaged"), qPrintable(refusalOf(linking.fileName())));
        // Qt ends at an empty section, so what stands behind it makes nothing sound.
        const QByteArray outside = QByteArray::fromHex("42000000080000000100ffffff") + QByteArray::fromHex("8800000000");
        QFile hiding(filePath("hiding.qm"));
        QVERIFY(hiding.open(QIODevice::WriteOnly) && hiding.write(content.first(16) + outside + content.mid(16)) > 0);
        hiding.close();
        QVERIFY2(refusalOf(hiding.fileName()).contains("damaged"), qPrintable(refusalOf(hiding.fileName())));
        // Lengths and places that lead out of the file: refused or read, and no crash.
        for (qsizetype at = 16; at < content.size(); ++at)
            for (const char byte : {'\x80', '\x7e'}) {
                QFile file(filePath("damaged.qm"));
                QVERIFY(file.open(QIODevice::WriteOnly));
                file.write(QByteArray(content).replace(at, 1, QByteArray(1, byte)));
                file.close();
                refusalOf(file.fileName());
            }
    }

    void aKeptLanguageIsUsedAndAFaultLeavesEnglish()
    {
        QSettings settings(filePath("kept.ini"), QSettings::IniFormat);
        LanguageInUse language(program);
        rememberLanguage(&settings, "de");
        QCOMPARE(chooseLanguage(language, {}, &settings), QString());
        QCOMPARE(language.language().name, QString("Deutsch"));
        language.use("en");
        rememberLanguage(&settings, catalogueFor("0.4.0"));
        const QString why = chooseLanguage(language, {}, &settings);
        QVERIFY2(why.contains("0.4.0") && !why.contains('\n'), qPrintable(why));
        QCOMPARE(language.language().tag, QString("en"));
        QVERIFY_EXCEPTION_THROWN(chooseLanguage(language, "xx", &settings), protocols::Error);
        QCOMPARE(chooseLanguage(language, "de", &settings), QString());
        QCOMPARE(language.language().tag, QString("de"));
    }

    void theStartPageOffersLanguagesAndSaysWhoReviewedThem()
    {
        AppOptions options;
        tests::support::ShownWindow english(options);
        auto& list = english.widget<QComboBox>("languageList");
        QCOMPARE(list.currentText(), QString("English"));
        QVERIFY(english.widget<QLabel>("translationReview").isHidden());
        const int german = list.findText("Deutsch");
        QVERIFY(german > 0);
        list.setCurrentIndex(german);
        Q_EMIT list.activated(german);
        QCOMPARE(english.window.chosenLanguage(), QString("de"));
        QVERIFY(!english.window.isVisible());

        LanguageInUse language(program);
        language.use("de");
        options.language = language.language();
        options.languageFault = "Fehler";
        {
            tests::support::ShownWindow shown(options);
            QCOMPARE(shown.widget<QLabel>("translationReview").text(), QString("Übersetzung nicht geprüft"));
            QCOMPARE(shown.widget<QComboBox>("languageList").currentText(), QString("Deutsch"));
            QCOMPARE(shown.widget<QLabel>("startMessage").text(), QString("Fehler"));
        }
        language.use(catalogueFor("0.6.0"));
        options.language = language.language();
        tests::support::ShownWindow own(options);
        QCOMPARE(own.widget<QComboBox>("languageList").currentText(), QString("Platt"));
        QCOMPARE(own.widget<QLabel>("translationReview").text(), QString("translation reviewed by Fiete"));
    }

    void theProgramRefusesALanguageInOneLine()
    {
        const QStringList home{"HOME=" + filePath("home"), "QT_QPA_PLATFORM=offscreen"};
        const auto unknown = support::runProgram({"--language", "xx"}, home);
        QCOMPARE(unknown.exitCode, 2);
        QCOMPARE(unknown.messages().size(), 1);
        QVERIFY2(unknown.err.contains("'xx'"), qPrintable(unknown.err));
        const auto older = support::runProgram({"--language", catalogueFor("0.5.0")}, home);
        QCOMPARE(older.exitCode, 2);
        QVERIFY2(older.messages().size() == 1 && older.err.contains("0.5.0"), qPrintable(older.err));
    }

    void aStudyNamesTheFontThatItsParticipantsNeed()
    {
        if (missingFontPackage("th").isEmpty()) QSKIP("this computer has a font for Thai");
        tests::support::OpenWindow open(newStudy(tests::support::wholeStudy({.language = "th"})));
        QVERIFY2(open.message("studyMessage").contains("apt-get install fonts-noto-core"),
                 qPrintable(open.message("studyMessage")));
        tests::support::OpenWindow english(newStudy(tests::support::wholeStudy()));
        QCOMPARE(english.message("studyMessage"), QString());
    }

    void aMissingFontIsAskedForByName()
    {
        // Fonts of this test: none, and DejaVu alone.
        const auto fontsIn = [&](const QString& folder) {
            QFile file(filePath("fonts.conf"));
            if (!file.open(QIODevice::WriteOnly)) return QString();
            file.write(QStringLiteral("<?xml version=\"1.0\"?><!DOCTYPE fontconfig SYSTEM \"fonts.dtd\"><fontconfig><dir>%1</dir>"
                                      "<cachedir>%2</cachedir></fontconfig>")
                           .arg(folder, filePath("font-cache"))
                           .toUtf8());
            return "FONTCONFIG_FILE=" + file.fileName();
        };
        const QStringList home{"HOME=" + filePath("home"), "QT_QPA_PLATFORM=offscreen"};
        QVERIFY(QDir().mkpath(filePath("no-fonts")));
        const auto none = support::runProgram({"--language", "en"}, home + QStringList{fontsIn(filePath("no-fonts"))});
        QCOMPARE(none.exitCode, 3);
        QVERIFY2(none.err.contains("apt-get install fonts-dejavu-core"), qPrintable(none.err));
        const auto chinese = support::runProgram({"--language", catalogueFor("0.6.0", "zh_CN")},
                                                 home + QStringList{fontsIn("/usr/share/fonts/truetype/dejavu")});
        QCOMPARE(chinese.exitCode, 3);
        QVERIFY2(chinese.messages().size() == 1 && chinese.err.contains("apt-get install fonts-wqy-microhei"),
                 qPrintable(chinese.err));
    }
};

QTEST_MAIN(AppLanguagesTest)
#include "app_languages_test.moc"
