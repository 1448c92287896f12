// Widths for which figures are drawn. Letters keep their size, so a narrow figure has less room for everything else.
#pragma once

namespace reports {

enum class FigureWidth {
    TwoColumns,  ///< 180 mm in print, about 960 px
    OneColumn,   ///< 88 mm in print, about 490 px; also for phones
};

}  // namespace reports
