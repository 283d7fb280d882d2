use tracer::*; use glam::*;
fn main(){
 for thin in [0.5f32,1e-2,1e-4,1e-6]{
 let mesh=Mesh{positions:vec![Vec3::new(-1.0,0.0,0.0),Vec3::new(1.0,0.0,0.0),Vec3::new(0.0,0.0,-2.0*thin)],triangles:vec![[0,1,2]],normals:None};
 let m=brdf_models::parse_model_n::<1>("lambert").unwrap().built.material;
 let s=Scene::new(Description{camera:Camera{eye:DVec3::Y,target:DVec3::ZERO,up:DVec3::X,vertical_fov_deg:20.0},materials:vec![m],objects:vec![Object::new(Shape::Mesh(mesh),0)],lights:vec![],environment:None}).unwrap();
 let mut miss=[0;3];
 for k in 0..1000{ let x=-0.4+0.8*k as f32/1000.0;
  if s.meet(Vec3::new(x,1.0,-0.5*thin),-Vec3::Y).is_none(){miss[0]+=1;}
  let d=Vec3::new(1e-3,-1.0,1e-3).normalize(); let t=Vec3::new(x,0.0,-0.5*thin); if s.meet(t-d,d).is_none(){miss[1]+=1;}
  if s.meet(Vec3::new(x,1.0,-0.5*thin),Vec3::new(1e-7,-1.0,0.0)).is_none(){miss[2]+=1;}
 }
 println!("{thin} {miss:?} tris {}", s.triangles());
 }
}
