// Recipes: a long array told by the formula of its entries, so that a request needs not hold it, as in
//   x_i = ((i*2654435761) mod 2^32)/2^32 + offset, i=0..n-1, all in IEEE double
//   a_k=((k*M+A) mod 2^32)/2^32, b=0.8*a+0.2*c (a remark), k row-major, 800 rows x 1280 cols, float64
// Whole numbers are added, multiplied and reduced exactly; every other operation is rounded once to double.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace study::analyse {

struct RecipeArrays {
    std::map<std::string, std::vector<double>> arrays;  ///< by name, without its index
    std::string last;                                   ///< the array that was defined last
    std::size_t rows = 0;                               ///< 0 where the recipe tells no shape
    std::size_t columns = 0;
};

/// `constants`: the numbers that the formulas may name (n, offset). Throws RequestFault.
RecipeArrays arraysOfRecipe(const std::string& recipe, const std::map<std::string, double>& constants);

/// A formula of numbers alone: "1/3", "sqrt(2)/2", "1e-3". Throws RequestFault.
double valueOfFormula(const std::string& formula);

}  // namespace study::analyse
