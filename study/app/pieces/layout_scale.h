// Gaps and margins that grow with the window, as its text does.
#pragma once

class QLayout;

namespace study::app {

/// Multiplies the spacing and the margins of the layout, and of all layouts in it, by `scale` (scaleOf()). The usual ones are
/// those of the first call; a layout that came later is scaled by the next call.
void scaleGaps(QLayout& layout, double scale);

}  // namespace study::app
