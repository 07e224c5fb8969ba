package Modelica "What the wrappers use of the Modelica Standard Library 4, with its names and equations; not that library"
  package Icons
    partial package Package
    end Package;
    partial model Example
    end Example;
    partial function Function
    end Function;
  end Icons;

  package Units
    package SI
      type Acceleration = Real(final unit="m/s2");
      type Angle = Real(final unit="rad");
      type Area = Real(final unit="m2");
      type Current = Real(final unit="A");
      type Density = Real(final unit="kg/m3");
      type DynamicViscosity = Real(final unit="Pa.s");
      type Force = Real(final unit="N");
      type Length = Real(final unit="m");
      type Mass = Real(final unit="kg", min=0);
      type Position = Real(final unit="m");
      type Pressure = Real(final unit="Pa");
      type Resistance = Real(final unit="Ohm");
      type Temperature = Real(final unit="K");
      type Time = Real(final unit="s");
      type TranslationalDampingConstant = Real(final unit="N.s/m");
      type TranslationalSpringConstant = Real(final unit="N/m");
      type Velocity = Real(final unit="m/s");
      type Voltage = Real(final unit="V");
      type Volume = Real(final unit="m3");
    end SI;
  end Units;

  package Blocks
    package Interfaces
      connector RealInput = input Real;
      connector RealOutput = output Real;
    end Interfaces;
  end Blocks;

  package Mechanics
    package Translational
      package Interfaces
        connector Flange_a
          Modelica.Units.SI.Position s;
          flow Modelica.Units.SI.Force f;
        end Flange_a;

        connector Flange_b
          Modelica.Units.SI.Position s;
          flow Modelica.Units.SI.Force f;
        end Flange_b;

        partial model PartialCompliant
          Flange_a flange_a;
          Flange_b flange_b;
          Modelica.Units.SI.Position s_rel(start=0);
          Modelica.Units.SI.Force f;
        equation
          s_rel = flange_b.s - flange_a.s;
          flange_b.f = f;
          flange_a.f = -f;
        end PartialCompliant;
      end Interfaces;

      package Components
        model Fixed
          parameter Modelica.Units.SI.Position s0 = 0;
          Interfaces.Flange_b flange;
        equation
          flange.s = s0;
        end Fixed;

        model Mass
          parameter Modelica.Units.SI.Mass m = 1;
          Interfaces.Flange_a flange_a;
          Interfaces.Flange_b flange_b;
          Modelica.Units.SI.Position s;
          Modelica.Units.SI.Velocity v;
          Modelica.Units.SI.Acceleration a;
        equation
          flange_a.s = s;
          flange_b.s = s;
          v = der(s);
          a = der(v);
          m*a = flange_a.f + flange_b.f;
        end Mass;

        model Spring
          extends Interfaces.PartialCompliant;
          parameter Modelica.Units.SI.TranslationalSpringConstant c = 1;
          parameter Modelica.Units.SI.Position s_rel0 = 0;
        equation
          f = c*(s_rel - s_rel0);
        end Spring;
      end Components;

      package Sources
        model ConstantForce
          parameter Modelica.Units.SI.Force f_constant;
          Interfaces.Flange_b flange;
        equation
          flange.f = -f_constant;
        end ConstantForce;
      end Sources;
    end Translational;
  end Mechanics;
end Modelica;
