// A box to tick that grows with the text and can be seen in both themes; its text stands beside it as a label.
#pragma once

#include <QCheckBox>

namespace study::app {

class TickBox : public QCheckBox {
    Q_OBJECT
public:
    explicit TickBox(QWidget* parent);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    bool hitButton(const QPoint& point) const override { return rect().contains(point); }
    void paintEvent(QPaintEvent* event) override;
};

}  // namespace study::app
