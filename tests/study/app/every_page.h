// Every page of the window, one after another, for tests of what pages have in common.
#pragma once

#include <QApplication>
#include <QFont>

#include "tests/support/open_window.h"

namespace tests {

class EveryPage : public support::WindowTest {
protected:
    /// Receives the window on each page, with the name of the page.
    using Look = std::function<void(QWidget& window, const char* page)>;
    /// Calls `look` on every page of the window.
    void visitPages(const Look& look);

    QFont m_font = QApplication::font();
    std::string m_language = "en";  ///< of the protocol

private:
    void visitPreparation(support::OpenWindow& open, const Look& look);
    void visitQuestions(support::OpenWindow& open, const Look& look);
    void visitPanels(support::OpenWindow& open, const Look& look);
    void visitAround(support::OpenWindow& open, const Look& look);
    void visitPhotographs(support::OpenWindow& open, const Look& look);
    static void visitEditor(support::OpenWindow& open, const Look& look);
    static void visitRehearsal(support::OpenWindow& open, const Look& look);
    void visitMonitor(support::OpenWindow& open, const Look& look);
};

}  // namespace tests
