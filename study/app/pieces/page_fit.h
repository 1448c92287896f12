// Text and gaps of pages that follow the room: gaps grow with the window, and a page that is too high for its window takes a
// smaller type until its main buttons are in view.
#pragma once

#include <QObject>

class QLayout;
class QScrollArea;
class QWidget;

namespace study::app {

/// Multiplies the spacing and the margins of the layout, and of all layouts in it, by `scale` (scaleOf()) and by the zoom of
/// their page. The usual ones are those of the first call; a layout that came later is scaled by the next call.
void scaleGaps(QLayout& layout, double scale);

/// Fits a page into the area that scrolls it, unless the page has the property "scrollsAlways". Limits its width for easy reading
/// and chooses the size of its type: the usual one, or the largest smaller one with which the page needs no scrolling. Where no
/// type is small enough, the main buttons that can be pressed must be in view, and otherwise the page keeps its usual type and
/// scrolls. The type stays while the page fits, so that text does not change its size from one presentation to the next.
class PageFit : public QObject {
    Q_OBJECT
public:
    /// The area owns the fit, which `of` finds.
    PageFit(QScrollArea& area, QWidget& page);
    static PageFit* of(const QScrollArea& area);

    /// Sets the largest type, percent of the usual one. 100 unless set.
    void setLargest(int percent);
    /// Chooses the type anew, because the page shows something else.
    void refit() { fitLater(Search::FromLargest); }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    enum class Search { None, FromCurrent, FromLargest };

    void limitWidth();
    void showFocus();
    void fitLater(Search search);
    void fit();
    bool takeLargest(int first, int smallest, bool (PageFit::*isEnough)() const);
    bool scrollsAtUsualSize(int first);
    bool isInView() const;
    bool showsMainButtons() const;
    void zoom(int percent);

    QScrollArea& m_area;
    QWidget& m_page;
    int m_largest = 100;
    int m_percent = 100;
    double m_points = 0;        ///< size of plain text for which the type was chosen, pt
    double m_zoomedPoints = 0;  ///< size of plain text when the type of the page was set, pt
    Search m_due = Search::None;
    bool m_scrolls = false;  ///< no type is small enough for the whole page
    bool m_isZooming = false;
};

}  // namespace study::app
