//! Every source this workspace cites, one item each: a docstring that cites something else does
//! not build.

/// R. Featherstone, *Rigid Body Dynamics Algorithms*, Springer, 2008.
#[derive(Debug)]
pub enum Featherstone2008 {}
/// A. Ellery, *Space Robotics Part 2: Space-based Manipulators*, International Journal of Advanced
/// Robotic Systems 1(3), 2004.
#[derive(Debug)]
pub enum Ellery2004 {}
/// Y. Umetani, K. Yoshida, *Resolved motion rate control of space manipulators with generalized
/// Jacobian matrix*, IEEE Transactions on Robotics and Automation 5(3), 1989.
#[derive(Debug)]
pub enum UmetaniYoshida1989 {}

/// K. Yoshida, R. Kurazume, Y. Umetani, *Dual arm coordination in space free-flying robot*, IEEE
/// International Conference on Robotics and Automation, 1991.
#[derive(Debug)]
pub enum YoshidaKurazumeUmetani1991 {}
/// Z. Vafa, S. Dubowsky, *The kinematics and dynamics of space manipulators: the virtual
/// manipulator approach*, International Journal of Robotics Research 9(4), 1990.
#[derive(Debug)]
pub enum VafaDubowsky1990 {}
/// W. Khalil, J.-F. Kleinfinger, *A new geometric notation for open and closed-loop robots*, IEEE
/// International Conference on Robotics and Automation, 1986.
#[derive(Debug)]
pub enum KhalilKleinfinger1986 {}
/// E. Papadopoulos, S. Dubowsky, *Dynamic singularities in free-floating space manipulators*, ASME
/// Journal of Dynamic Systems, Measurement, and Control 115, 1993.
#[derive(Debug)]
pub enum PapadopoulosDubowsky1993 {}
/// D. Nenchev, Y. Umetani, K. Yoshida, *Analysis of a redundant free-flying spacecraft/manipulator
/// system*, IEEE Transactions on Robotics and Automation 8(1), 1992.
#[derive(Debug)]
pub enum Nenchev1992 {}
/// D. Orin, A. Goswami, S.-H. Lee, *Centroidal dynamics of a humanoid robot*, Autonomous Robots 35,
/// 2013.
#[derive(Debug)]
pub enum Orin2013 {}
/// R. Longman, R. Lindberg, M. Zedd, *Satellite-mounted robot manipulators: new kinematics and
/// reaction moment compensation*, International Journal of Robotics Research 6(3), 1987.
#[derive(Debug)]
pub enum Longman1987 {}
/// H. Munthe-Kaas, *Runge-Kutta methods on Lie groups*, BIT Numerical Mathematics 38(1), 1998.
#[derive(Debug)]
pub enum MuntheKaas1998 {}
/// E. Hairer, S. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.,
/// Springer, 1993.
#[derive(Debug)]
pub enum Hairer1993 {}
/// K. Kreutz-Delgado, M. Long, H. Seraji, *Kinematic analysis of 7-DOF manipulators*, International
/// Journal of Robotics Research 11(5), 1992.
#[derive(Debug)]
pub enum KreutzDelgado1992 {}
/// Y. Nakamura, H. Hanafusa, *Inverse kinematic solutions with singularity robustness for robot
/// manipulator control*, ASME Journal of Dynamic Systems, Measurement, and Control 108, 1986.
#[derive(Debug)]
pub enum NakamuraHanafusa1986 {}
/// O. Khatib, *A unified approach for motion and force control of robot manipulators: the operational
/// space formulation*, IEEE Journal on Robotics and Automation 3(1), 1987.
#[derive(Debug)]
pub enum Khatib1987 {}
/// F. Bullo, R. Murray, *Tracking for fully actuated mechanical systems: a geometric framework*,
/// Automatica 35(1), 1999.
#[derive(Debug)]
pub enum BulloMurray1999 {}
/// M. Spong, *Modeling and control of elastic joint robots*, ASME Journal of Dynamic Systems, Measurement,
/// and Control 109, 1987.
#[derive(Debug)]
pub enum Spong1987 {}
/// B. Wie, *Space Vehicle Dynamics and Control*, 2nd ed., AIAA, 2008.
#[derive(Debug)]
pub enum Wie2008 {}
/// F. Markley, R. Reynolds, F. Liu, K. Lebsock, *Maximum torque and momentum envelopes for
/// reaction-wheel arrays*, AIAA Journal of Guidance, Control, and Dynamics 33(5), 2010.
#[derive(Debug)]
pub enum Markley2010 {}
/// N. Bedrossian, J. Paradiso, E. Bergmann, D. Rowell, *Steering law design for redundant
/// single-gimbal control moment gyroscopes*, AIAA Journal of Guidance, Control, and Dynamics 13(6),
/// 1990.
#[derive(Debug)]
pub enum Bedrossian1990 {}
/// H.-S. Oh, S. Vadali, *Feedback control and steering laws for spacecraft using single gimbal
/// control moment gyros*, Journal of the Astronautical Sciences 39(2), 1991.
#[derive(Debug)]
pub enum OhVadali1991 {}
/// S. Vadali, H.-S. Oh, S. Walker, *Preferred gimbal angles for single gimbal control moment gyros*,
/// AIAA Journal of Guidance, Control, and Dynamics 13(6), 1990.
#[derive(Debug)]
pub enum Vadali1990 {}
/// B. Wie, D. Bailey, C. Heiberg, *Singularity robust steering logic for redundant single-gimbal
/// control moment gyros*, AIAA Journal of Guidance, Control, and Dynamics 24(5), 2001.
#[derive(Debug)]
pub enum WieBaileyHeiberg2001 {}
/// R. Bland, *New finite pivoting rules for the simplex method*, Mathematics of Operations Research
/// 2(2), 1977.
#[derive(Debug)]
pub enum Bland1977 {}
/// F. L. Markley, J. L. Crassidis, *Fundamentals of Spacecraft Attitude Determination and Control*,
/// Springer, 2014.
#[derive(Debug)]
pub enum MarkleyCrassidis2014 {}
/// W. J. Cody, W. Waite, *Software Manual for the Elementary Functions*, Prentice-Hall, 1980.
#[derive(Debug)]
pub enum CodyWaite1980 {}
/// J. Luh, M. Walker, R. Paul, *On-line computational scheme for mechanical manipulators*, ASME
/// Journal of Dynamic Systems, Measurement, and Control 102(2), 1980.
#[derive(Debug)]
pub enum LuhWalkerPaul1980 {}
/// J. Carpentier, N. Mansard, *Analytical derivatives of rigid body dynamics algorithms*, Robotics:
/// Science and Systems, 2018.
#[derive(Debug)]
pub enum CarpentierMansard2018 {}
/// S. Singh, R. Russell, P. Wensing, *Efficient analytical derivatives of rigid-body dynamics using
/// spatial vector algebra*, IEEE Robotics and Automation Letters 7(2), 2022.
#[derive(Debug)]
pub enum Singh2022 {}
/// G. Golub, C. Van Loan, *Matrix Computations*, 4th ed., Johns Hopkins, 2013.
#[derive(Debug)]
pub enum GolubVanLoan2013 {}
/// H. N. Abramson (ed.), *The dynamic behavior of liquids in moving containers*, NASA SP-106, 1966.
#[derive(Debug)]
pub enum Abramson1966 {}
/// F. T. Dodge, *The new "Dynamic behavior of liquids in moving containers"*, Southwest Research
/// Institute, 2000.
#[derive(Debug)]
pub enum Dodge2000 {}
/// K. Hunt, F. Crossley, *Coefficient of restitution interpreted as damping in vibroimpact*, ASME
/// Journal of Applied Mechanics 42(2), 1975.
#[derive(Debug)]
pub enum HuntCrossley1975 {}
/// P. Dupont, V. Hayward, B. Armstrong, F. Altpeter, *Single state elastoplastic friction models*, IEEE
/// Transactions on Automatic Control 47(5), 2002.
#[derive(Debug)]
pub enum Dupont2002 {}
/// C. Canudas de Wit, H. Olsson, K. Åström, P. Lischinsky, *A new model for control of systems with
/// friction*, IEEE Transactions on Automatic Control 40(3), 1995.
#[derive(Debug)]
pub enum CanudasDeWit1995 {}
/// R. Mindlin, *Compliance of elastic bodies in contact*, ASME Journal of Applied Mechanics 16, 1949.
#[derive(Debug)]
pub enum Mindlin1949 {}
/// K. Johnson, *Contact Mechanics*, Cambridge University Press, 1985.
#[derive(Debug)]
pub enum Johnson1985 {}
/// Z. Farkas, G. Bartels, T. Unger, D. Wolf, *Frictional coupling between sliding and spinning motion*,
/// Physical Review Letters 90, 248302, 2003.
#[derive(Debug)]
pub enum Farkas2003 {}
