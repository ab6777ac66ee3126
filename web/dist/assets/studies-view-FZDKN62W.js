import{j as e}from"./chunk-U7U2WTVZ.js";function i(){return e("h1",{children:"StudiesView"})}export{i as StudiesView};
