// Page that stands in front while the display of a session is being connected. The window stays alive, and Esc stops it.
#pragma once

#include <QWidget>

class QPushButton;

namespace study::app {

class PageHead;

class ConnectingPage : public QWidget {
    Q_OBJECT
public:
    explicit ConnectingPage(QWidget* parent);

    /// Names the display that is waited for.
    void present(const QString& specification);

Q_SIGNALS:
    void stopRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    PageHead* m_head;
    QPushButton* m_stop;
};

}  // namespace study::app
