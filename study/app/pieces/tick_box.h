// Check box that grows with the text and is visible in both themes. Its text is a label next to the box.
#pragma once

#include <QCheckBox>

namespace study::app {

class TickBox : public QCheckBox {
    Q_OBJECT
public:
    explicit TickBox(QWidget* parent);
    /// A click on the caption is one on the box.
    void takeClicksOf(QWidget& caption);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    bool hitButton(const QPoint& point) const override { return rect().contains(point); }
    void paintEvent(QPaintEvent* event) override;
};

}  // namespace study::app
