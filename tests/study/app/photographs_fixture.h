// Photographs on the disk and the page that makes a data set from them, for its tests.
#pragma once

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <QTreeWidget>
#include <filesystem>

#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "study/app/pages/photographs/photographs_page.h"
#include "study/photographs/photograph_steps.h"
#include "tests/support/open_window.h"

namespace tests {

inline study::app::AppOptions photographOptions()
{
    study::app::AppOptions options;
    options.photographs = ::study::photographs::photographSteps();
    options.makeStudy = [](const study::app::NewStudyRequest&, const study::app::MakingProgress&) {
        return std::vector<std::string>();
    };
    return options;
}

inline std::filesystem::path pathOf(const QString& text) { return text.toStdString(); }

/// Chooses in the dialog that opens next, as a click on its button does.
inline void chooseInDialog(const QString& path)
{
    QTimer::singleShot(0, [path] {
        QFileDialog* dialog = nullptr;
        QTRY_VERIFY((dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) != nullptr);
        dialog->findChild<QLineEdit*>("fileNameEdit")->setText(path);
        QPushButton* accept = nullptr;
        for (const auto role : {QDialogButtonBox::Open, QDialogButtonBox::Save})
            if (!accept) accept = dialog->findChild<QDialogButtonBox*>()->button(role);
        QTest::mouseClick(accept, Qt::LeftButton);
    });
}

class PhotographsTest : public support::WindowTest {
protected:
    /// Photographs of three procedural fabrics: linen.png, satin.png (a lighter crop), felt.jpg.
    std::filesystem::path photographs(const char* folder)
    {
        const std::filesystem::path made = pathOf(filePath("procedural")), place = pathOf(filePath(QString::fromLatin1(folder)));
        if (!std::filesystem::exists(made)) {
            rendering::fabrics::ProceduralOptions options;
            options.fabrics = 3;
            options.samples = 2;
            rendering::fabrics::makeProceduralFabrics(made, options);
        }
        std::filesystem::create_directories(place);
        std::filesystem::copy_file(made / "F01/visual/000.png", place / "linen.png");
        std::filesystem::copy_file(made / "F02/visual/000.png", place / "satin.png");
        QImage(QString::fromStdString((made / "F03/visual/000.png").string()))
            .save(QString::fromStdString((place / "felt.jpg").string()), "JPG", 95);
        return place;
    }
    study::app::PhotographsPage& openPage(support::ShownWindow& shown)
    {
        shown.gui.click("photographsButton");
        return *qobject_cast<study::app::PhotographsPage*>(shown.window.currentPage());
    }
    study::app::PhotographsPage& openWith(support::ShownWindow& shown, const std::filesystem::path& place)
    {
        auto& page = openPage(shown);
        addTo(page, place);
        return page;
    }
    void addTo(study::app::PhotographsPage& page, const std::filesystem::path& place)
    {
        page.add(QString::fromStdString(place.string()));
        QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 30000);
    }
    static QString message(const study::app::PhotographsPage& page, const char* name)
    {
        const auto* bar = page.findChild<QLabel*>(QLatin1String(name));
        return bar->isVisible() ? bar->text() : QString();
    }
    static QStringList column(const study::app::PhotographsPage& page, int number)
    {
        QStringList texts;
        const auto* list = page.findChild<QTreeWidget*>("photographs");
        for (int row = 0; row < list->topLevelItemCount(); ++row) texts << list->topLevelItem(row)->text(number);
        return texts;
    }
    /// Types into a field of the page as the operator does.
    static void enter(support::ShownWindow& shown, const char* name, const QString& text)
    {
        shown.gui.focusOn(QString::fromLatin1(name));
        shown.gui.clear();
        shown.gui.type(text);
    }
    /// Moves the focus by the Tab key.
    static void tabTo(support::ShownWindow& shown, const char* name)
    {
        for (int press = 0; press < 80; ++press) {
            if (shown.window.focusWidget() && shown.window.focusWidget()->objectName() == QLatin1String(name)) return;
            QTest::keyClick(shown.window.focusWidget() ? shown.window.focusWidget() : &shown.window, Qt::Key_Tab);
        }
        QFAIL(qPrintable(QStringLiteral("Tab does not lead to %1").arg(QLatin1String(name))));
    }
    static void press(support::ShownWindow& shown, Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QTest::keyClick(shown.window.focusWidget(), key, modifiers);
    }
    bool writesDataset(support::ShownWindow& shown, study::app::PhotographsPage& page, const std::filesystem::path& folder)
    {
        enter(shown, "newDatasetField", QString::fromStdString(folder.string()));
        shown.gui.click("writeDatasetButton");
        return QTest::qWaitFor([&] { return !page.isBusy(); }, 30000) && std::filesystem::exists(folder / "dataset.json");
    }
};

}  // namespace tests
