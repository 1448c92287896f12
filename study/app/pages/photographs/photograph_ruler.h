// A photograph with a ruler: the operator marks two points on it. By mouse: click each point. By keys: arrow keys move the
// cross, Space sets a point, Delete removes both.
#pragma once

#include <QImage>
#include <QSize>
#include <QWidget>
#include <optional>
#include <vector>

namespace study::app {

class PhotographRuler : public QWidget {
    Q_OBJECT
public:
    explicit PhotographRuler(QWidget* parent);

    /// `picture`: the photograph scaled down; `sizePx`: its own size. Keeps the points where they are if the size is the same.
    void setPhotograph(const QImage& picture, const QSize& sizePx);
    QSize sizePx() const { return m_sizePx; }
    /// Distance of the two points, in pixels of the photograph; empty until both are set.
    std::optional<double> lengthPx() const;
    /// Place of a point of the photograph on the widget; for tests that click.
    QPoint placeOf(const QPointF& pointPx) const;

    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override;
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

Q_SIGNALS:
    void pointsChanged();

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    QRectF shown() const;
    void setPoint(const QPointF& pointPx);
    void removePoints();
    void moveCross(int key, bool isFine);
    void describe();

    QImage m_picture;
    QSize m_sizePx;
    QPointF m_crossPx;
    std::vector<QPointF> m_pointsPx;  ///< at most two
};

}  // namespace study::app
