//! From a description to a scene: shapes into world space, lights and their powers, the BVH.

use crate::bvh::Bvh;
use crate::geometry::{Geometry, TriangleInfo};
use crate::light::{Emitter, Light, Lights, RectLight, SphereLight, TriangleLight};
use crate::mode::{Emission, Mode};
use crate::path::NONE;
use crate::scene::{Description, MAX_PRIMITIVES, Object, Scene, SceneError, Surface};
use crate::shape::{Mesh, Quad, Shape, Sphere, Triangle};
use glam::{DVec3, Vec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// A mesh object that shines: lights need the primitives' final order.
struct Shining {
    object: usize,
    light: usize,
}

pub(crate) struct Builder<const N: usize, S: Mode<N>> {
    pub(crate) description: Description<N, S>,
    geometry: Geometry,
    quad_corners: Vec<[Vec3; 4]>,
    sphere_objects: Vec<u32>,
    quad_objects: Vec<u32>,
    surfaces: Vec<Surface>,
    /// On their way into the tree, and what they are.
    triangles: Vec<Triangle>,
    infos: Vec<TriangleInfo>,
    shining: Vec<Shining>,
    pub(crate) lights: Vec<Light<S::Emission>>,
    /// What a light's share in the choice goes by; `None` keeps it out.
    pub(crate) powers: Vec<Option<f64>>,
    left_out: usize,
}

impl<const N: usize, S: Mode<N>> Builder<N, S> {
    pub(crate) fn new(description: Description<N, S>) -> Result<Self, SceneError> {
        description.camera.check().map_err(SceneError::Camera)?;
        Ok(Self {
            description,
            geometry: Geometry::default(),
            quad_corners: Vec::new(),
            sphere_objects: Vec::new(),
            quad_objects: Vec::new(),
            surfaces: Vec::new(),
            triangles: Vec::new(),
            infos: Vec::new(),
            shining: Vec::new(),
            lights: Vec::new(),
            powers: Vec::new(),
            left_out: 0,
        })
    }

    pub(crate) fn finish(mut self, mode: S) -> Result<Scene<N, S>, SceneError> {
        let objects = std::mem::take(&mut self.description.objects);
        for (index, object) in objects.iter().enumerate() {
            self.object(index, object)
                .map_err(|reason| SceneError::Object {
                    object: index,
                    reason,
                })?;
        }
        let primitives = self.sphere_objects.len() + self.quad_objects.len() + self.triangles.len();
        if primitives > MAX_PRIMITIVES as usize {
            return Err(SceneError::TooMany);
        }
        self.close_geometry(&objects);
        self.point_lights()?;
        let environment = self.environment()?;
        let selection = self.description.selection;
        let shared: Arc<[_]> = std::mem::take(&mut self.lights).into();
        let lights = Lights::new(Arc::clone(&shared), &self.powers, selection);
        let with_constant: Vec<_> = (self.powers.iter())
            .zip(shared.iter())
            .map(|(power, light)| match light.emitter {
                Emitter::Constant => Some(self.environment_power(light.strength.brightness())),
                _ => *power,
            })
            .collect();
        let all_lights = Lights::new(shared, &with_constant, selection);
        Ok(Scene {
            mode,
            camera: self.description.camera,
            materials: self.description.materials,
            smooth: !self.geometry.normals.is_empty(),
            geometry: self.geometry,
            surfaces: self.surfaces,
            lights,
            all_lights,
            environment,
            left_out: self.left_out,
        })
    }

    fn object(&mut self, index: usize, object: &Object<N, S>) -> Result<(), String> {
        let materials = self.description.materials.len();
        if object.material >= materials {
            return Err(format!("material {} of {materials}", object.material));
        }
        if !object.transform.is_finite() {
            return Err("transform must be finite".into());
        }
        let emission = shining(object);
        if emission.is_some_and(|e| !e.is_finite()) {
            return Err("emission must be finite".into());
        }
        self.surfaces.push(Surface {
            material: object.material as u32,
            light: NONE,
            one_sided: object.one_sided,
        });
        match &object.shape {
            Shape::Sphere { center, radius } => self.sphere(index, object, *center, *radius),
            Shape::Quad {
                corner,
                edge_u,
                edge_v,
            } => self.quad(index, object, [*corner, *edge_u, *edge_v]),
            Shape::Mesh(mesh) => self.mesh(index, object, mesh),
        }
    }

    fn sphere(
        &mut self,
        index: usize,
        object: &Object<N, S>,
        center: DVec3,
        radius: f64,
    ) -> Result<(), String> {
        let m = object.transform.matrix3;
        let scales = [m.x_axis.length(), m.y_axis.length(), m.z_axis.length()];
        let scale = scales[0];
        let skew = [
            m.x_axis.dot(m.y_axis),
            m.x_axis.dot(m.z_axis),
            m.y_axis.dot(m.z_axis),
        ];
        // rotations given with seven digits still count as such
        let uniform = scales.iter().all(|s| (s - scale).abs() <= 1e-5 * scale)
            && skew.iter().all(|s| s.abs() <= 1e-5 * scale * scale);
        if !uniform {
            return Err("a sphere takes rotation, translation and uniform scale only".into());
        }
        let center = object.transform.transform_point3(center).as_vec3();
        let radius = (radius * scale) as f32;
        if !(radius > 0.0 && radius.is_finite() && center.is_finite()) {
            return Err(
                "radius must be positive, radius and centre finite in single precision".into(),
            );
        }
        self.geometry.spheres.push(Sphere { center, radius });
        self.sphere_objects.push(index as u32);
        let r = f64::from(radius);
        self.shine(
            index,
            object,
            4.0 * PI * r * r,
            Emitter::Sphere(SphereLight { center, radius }),
        );
        Ok(())
    }

    fn quad(
        &mut self,
        index: usize,
        object: &Object<N, S>,
        [corner, u, v]: [DVec3; 3],
    ) -> Result<(), String> {
        let corner = object.transform.transform_point3(corner);
        let u = object.transform.transform_vector3(u);
        let v = object.transform.transform_vector3(v);
        let cross = u.cross(v);
        let area = cross.length();
        let (dual_u, dual_v) = (
            v.cross(cross) / (area * area),
            cross.cross(u) / (area * area),
        );
        let finite = corner.as_vec3().is_finite()
            && dual_u.as_vec3().is_finite()
            && dual_v.as_vec3().is_finite();
        if !(area > 0.0 && finite) {
            return Err("the edges must span an area, finite in single precision".into());
        }
        let normal = cross / area;
        self.geometry.quads.push(Quad {
            corner: corner.as_vec3(),
            normal: normal.as_vec3(),
            dual_u: dual_u.as_vec3(),
            dual_v: dual_v.as_vec3(),
        });
        let corners = [corner, corner + u, corner + u + v, corner + v].map(|c| c.as_vec3());
        self.quad_corners.push(corners);
        self.quad_objects.push(index as u32);
        let rectangle = u.dot(v).abs() <= 1e-6 * u.length() * v.length();
        let emitter = if rectangle {
            let x = u.normalize();
            Emitter::Rect(RectLight {
                corner: corner.as_vec3(),
                x: x.as_vec3(),
                y: normal.cross(x).as_vec3(),
                z: normal.as_vec3(),
                extent: [u.length() as f32, v.length() as f32],
            })
        } else {
            let [a, b, c, d] = corners;
            let halves = [[a, b, c], [a, c, d]].map(|corners| Triangle { corners });
            // both halves are the one primitive; its number is known once all are counted
            match TriangleLight::new(halves.to_vec(), vec![NONE; 2]) {
                Some(light) => Emitter::Triangles(light),
                None => return Err("the edges must span an area".into()),
            }
        };
        self.shine(index, object, area, emitter);
        Ok(())
    }

    fn mesh(&mut self, index: usize, object: &Object<N, S>, mesh: &Mesh) -> Result<(), String> {
        check_mesh(mesh)?;
        let positions: Vec<Vec3> = mesh
            .positions
            .iter()
            .map(|p| object.transform.transform_point3(p.as_dvec3()).as_vec3())
            .collect();
        if !positions.iter().all(|p| p.is_finite()) {
            return Err("positions must be finite in single precision".into());
        }
        // normals turn with the inverse transpose; det > 0 keeps the front in front
        let m = object.transform.matrix3;
        let flip = m.determinant() < 0.0;
        let cofactors = m.determinant() * m.inverse().transpose();
        let first = self.triangles.len();
        self.triangles.reserve_exact(mesh.triangles.len());
        self.infos.reserve_exact(mesh.triangles.len());
        if mesh.normals.is_some() {
            (self.geometry.normals).reserve_exact(3 * mesh.triangles.len());
        }
        for corners in &mesh.triangles {
            let mut order = corners.map(|i| i as usize);
            if flip {
                order.swap(1, 2);
            }
            let triangle = Triangle {
                corners: order.map(|i| positions[i]),
            };
            if triangle.area() <= 0.0 {
                self.left_out += 1;
                continue;
            }
            let mut info = TriangleInfo {
                object: index as u32,
                normals: NONE,
            };
            if let Some(normals) = &mesh.normals {
                info.normals = self.geometry.normals.len() as u32;
                let sign = if flip { -1.0 } else { 1.0 };
                let turned = order.map(|i| (cofactors * normals[i].as_dvec3() * sign).as_vec3());
                self.geometry
                    .normals
                    .extend(turned.map(|n| n.normalize_or(triangle.normal())));
            }
            self.triangles.push(triangle);
            self.infos.push(info);
        }
        if let Some(emission) = shining(object).filter(|_| self.triangles.len() > first) {
            self.shining.push(Shining {
                object: index,
                light: self.lights.len(),
            });
            self.surfaces[index].light = self.lights.len() as u32;
            // filled in close_geometry, which knows the order of the leaves
            self.lights.push(Light {
                emitter: Emitter::Constant,
                strength: emission.clone(),
                prim: NONE,
            });
            self.powers.push(None);
        }
        Ok(())
    }

    /// Registers the emission of an analytic shape, if it has any.
    fn shine(
        &mut self,
        index: usize,
        object: &Object<N, S>,
        area: f64,
        emitter: Emitter<S::Emission>,
    ) {
        let Some(emission) = shining(object) else {
            return;
        };
        self.surfaces[index].light = self.lights.len() as u32;
        self.powers.push(Some(area * PI * emission.brightness()));
        self.lights.push(Light {
            emitter,
            strength: emission.clone(),
            prim: NONE,
        });
    }

    /// Orders the primitives, builds the tree, tells lights which primitives they are.
    fn close_geometry(&mut self, objects: &[Object<N, S>]) {
        (self.geometry).close([&self.sphere_objects[..], &self.quad_objects[..]].concat());
        for (prim, &object) in self.geometry.objects.iter().enumerate() {
            let light = self.surfaces[object as usize].light;
            if let Some(light) = self.lights.get_mut(light as usize) {
                light.prim = prim as u32;
                if let Emitter::Triangles(halves) = &mut light.emitter {
                    halves.belong_to(prim as u32);
                }
            }
        }
        let triangles = std::mem::take(&mut self.triangles);
        let infos = std::mem::take(&mut self.infos);
        if triangles.is_empty() {
            return;
        }
        // lights keep triangles as they were given
        let mut members: Vec<Vec<(Triangle, u32)>> = vec![Vec::new(); objects.len()];
        let shines: Vec<bool> = objects.iter().map(|o| shining(o).is_some()).collect();
        let bright = (infos.iter().zip(&triangles).zip(0..))
            .filter(|((info, _), _)| shines[info.object as usize]);
        let bright: Vec<(u32, Triangle)> = bright.map(|((_, t), i)| (i, *t)).collect();
        let (bvh, order) = Bvh::new(triangles);
        self.geometry.bvh = Some(bvh);
        let info = |i: &u32| (infos.get(*i as usize).copied()).unwrap_or(TriangleInfo::SPARE);
        self.geometry.triangles = order.iter().map(info).collect();
        let base = self.geometry.first_triangle();
        for (i, prim) in order.iter().zip(base..) {
            if let Ok(at) = bright.binary_search_by_key(i, |b| b.0) {
                members[info(i).object as usize].push((bright[at].1, prim));
            }
        }
        for shining in std::mem::take(&mut self.shining) {
            let members = std::mem::take(&mut members[shining.object]);
            let (members, prims) = members.into_iter().unzip();
            if let Some(light) = TriangleLight::new(members, prims) {
                let emission = objects[shining.object].emission.as_ref();
                let emission = emission.map_or(0.0, Emission::brightness);
                self.powers[shining.light] = Some(f64::from(light.area()) * PI * emission);
                self.lights[shining.light].emitter = Emitter::Triangles(light);
            }
        }
    }

    /// Half the diagonal of the analytic shapes' and triangles' bounding box.
    pub(crate) fn radius(&self) -> f64 {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let mut grow = |p: Vec3| {
            low = low.min(p);
            high = high.max(p);
        };
        for s in &self.geometry.spheres {
            grow(s.center - s.radius);
            grow(s.center + s.radius);
        }
        self.quad_corners.iter().flatten().for_each(|&p| grow(p));
        if let Some(bvh) = &self.geometry.bvh {
            bvh.bounds().into_iter().for_each(grow);
        }
        let diagonal = f64::from((high - low).length());
        if diagonal.is_finite() {
            0.5 * diagonal
        } else {
            0.0
        }
    }
}

/// What an object sends out, if anything.
fn shining<const N: usize, S: Mode<N>>(object: &Object<N, S>) -> Option<&S::Emission> {
    object.emission.as_ref().filter(|e| !e.is_zero())
}

fn check_mesh(mesh: &Mesh) -> Result<(), String> {
    let count = mesh.positions.len();
    if let Some(bad) = mesh
        .triangles
        .iter()
        .flatten()
        .find(|&&i| i as usize >= count)
    {
        return Err(format!("index {bad} of {count} positions"));
    }
    match &mesh.normals {
        Some(normals) if normals.len() != count => {
            Err(format!("{} normals for {count} positions", normals.len()))
        }
        _ => Ok(()),
    }
}
