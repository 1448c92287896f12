// Layout that puts widgets in a row and starts a new row when the row is full. Bars of buttons stay complete at every text
// size. Rows are aligned left.
#pragma once

#include <QLayout>
#include <memory>
#include <vector>

namespace study::app {

class FlowLayout : public QLayout {
    Q_OBJECT
public:
    FlowLayout(int gapPx, int rowGapPx, QWidget* parent = nullptr);
    ~FlowLayout() override;

    /// Multiplies both gaps.
    void setScale(double scale);

    void addItem(QLayoutItem* item) override;
    int count() const override { return static_cast<int>(m_items.size()); }
    QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;
    Qt::Orientations expandingDirections() const override { return {}; }
    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override;
    QSize sizeHint() const override;
    QSize minimumSize() const override;
    void setGeometry(const QRect& rect) override;

private:
    enum class Placing { Try, Do };
    /// Lays the items out in `rect` and returns the height used. Try only measures.
    int place(const QRect& rect, Placing placing) const;
    void placeRow(const QRect& rect, std::size_t first, std::size_t end, int top, int height) const;

    int m_usualGapPx;
    int m_usualRowGapPx;
    int m_gapPx;  ///< scaled
    int m_rowGapPx;
    std::vector<std::unique_ptr<QLayoutItem>> m_items;
};

}  // namespace study::app
