//! The scene's convention applied to its materials.

use std::ops::Range;

use super::PreparedScene;
use crate::light::Light;
use crate::reflectance::{BrightnessFormula, Reflectance};
use crate::scene::Scene;
use crate::shape::{Accuracy, Primitive, TracingError};

#[derive(Clone, Debug)]
pub(super) struct PreparedFormula {
    pub(super) formula: BrightnessFormula,
    /// The accuracy of a ray whose hit is shaded with this formula.
    pub(super) accuracy: Accuracy,
    /// The clearances within its outline at which a shape has to be traced with 32 digits.
    pub(super) doubtful_in_outline: Range<f64>,
}

/// The convention applied to each material of a scene, and finally to a missing material.
pub(super) fn formulas(scene: &Scene) -> Vec<PreparedFormula> {
    let without_material = Reflectance { diffuse: 0.0, specular: 0.0, shininess: 1.0 };
    let materials = scene.materials.iter().map(|material| &material.reflectance);
    let steepest_edge = scene.lights.iter().map(Light::steepest_edge).fold(0.0, f64::max);
    let formulas = materials.chain([&without_material]).map(|material| {
        let formula = BrightnessFormula::new(scene.convention, material);
        let shininess = (formula.specular > 0.0).then_some(formula.shininess);
        let accuracy = Accuracy::for_shading(shininess, steepest_edge);
        let doubtful_in_outline = accuracy.doubtful_clearance(&TracingError::IN_OUTLINE);
        PreparedFormula { formula, accuracy, doubtful_in_outline }
    });
    formulas.collect()
}

impl PreparedScene {
    pub(super) fn prepared_formula(&self, primitive: Primitive) -> &PreparedFormula {
        &self.formulas[self.formula_index(primitive)]
    }

    /// Tells the materials of primitives apart.
    pub(crate) fn formula_index(&self, primitive: Primitive) -> usize {
        let shape = &self.shapes[primitive.shape];
        shape.geometry.material_of(primitive.part).unwrap_or(shape.formula)
    }

    /// The convention applied to a primitive's material.
    #[must_use]
    pub fn formula(&self, primitive: Primitive) -> &BrightnessFormula {
        self.expect_single_numbers();
        &self.prepared_formula(primitive).formula
    }

    /// The convention applied where there is no material.
    pub(crate) fn formula_without_material(&self) -> &BrightnessFormula {
        self.expect_single_numbers();
        &self.formulas[self.scene.materials.len()].formula
    }
}
