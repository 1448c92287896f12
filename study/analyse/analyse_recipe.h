// Recipes: formulas for the entries of long arrays, so that a request need not list them. Two examples:
//   x_i = ((i*2654435761) mod 2^32)/2^32 + offset, i=0..n-1, all in IEEE double
//   a_k=((k*M+A) mod 2^32)/2^32, b=0.8*a+0.2*c (a remark), k row-major, 800 rows x 1280 cols, float64
// Whole numbers are added, multiplied and reduced exactly. Every other operation is rounded once to double.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace study::analyse {

struct RecipeArrays {
    std::map<std::string, std::vector<double>> arrays;  ///< by name, without the index
    std::string last;                                   ///< name of the array that is defined last
    std::size_t rows = 0;                               ///< 0 where the recipe states no shape
    std::size_t columns = 0;
};

/// The most entries of all arrays that the recipes of one request make, 80 MB; and the most entries of an array x characters of
/// its recipe, which take some seconds.
inline constexpr double mostRecipeEntries = 1e7, mostRecipeWork = 1e9;

/// What a recipe makes: the entries of all its arrays, and its entries x characters.
struct RecipeCost {
    double entries = 0, work = 0;
};

/// The cost of arraysOfRecipe(), without making the arrays. Throws RequestFault as it does.
RecipeCost costOfRecipe(const std::string& recipe, const std::map<std::string, double>& constants);

/// `constants` are the numbers that the formulas may name, for instance n and offset. Throws RequestFault.
RecipeArrays arraysOfRecipe(const std::string& recipe, const std::map<std::string, double>& constants);

/// The value of a formula without names: "1/3", "sqrt(2)/2", "1e-3". Throws RequestFault.
double valueOfFormula(const std::string& formula);

}  // namespace study::analyse
